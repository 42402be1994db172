// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "manager_habits.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/command_box.hpp"
#include "rave/bus/event_log.hpp"
#include "rave/bus/standstill.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/wish_box.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/findings.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/pulse.hpp"
#include "roster_book.hpp"

namespace rave::manager {

/// A manager's end of the bus, as far as it is alike in lock-step and in real time: who is there
/// and fits, what hosts say of their robots and know at the end, requests, the state of the run.
/// Belongs to one thread.
class ManagerEndpoint {
 public:
  /// `begin_wish` and `on_command` may be empty: nobody on the bus can ask anything, or drive.
  /// `log` is not owned and may be null. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<ManagerEndpoint>> open(const bus::BusConfig& config,
                                                                     lock_step::Identity identity,
                                                                     LogSink* log,
                                                                     bus::BeginWish begin_wish,
                                                                     bus::OnCommand on_command);

  /// For the topics that only one kind of run has.
  [[nodiscard]] bus::Bus& bus() noexcept { return *bus_; }
  /// Wakes `waits` when findings or requests come.
  Status wake(bus::WaitSet& waits);
  /// ... and when processes come or go; then look_at_processes() is due after each wait.
  Status wake_for_processes(bus::WaitSet& waits);
  /// Tells the others that this manager is here: when it can hear what they answer.
  Status introduce();

  /// Sleeps until something has come, the time is over or `stop` is set. `step`: of the run.
  void wait(bus::WaitSet& waits, std::uint64_t step, Duration timeout,
            const std::stop_token& stop) {
    pulse_.beat({step});
    static_cast<void>(waits.wait(timeout, stop));
  }
  /// Begins what others ask on the bus, and answers what is done.
  void serve_requests() {
    if (wishes_) wishes_->serve();
    if (commands_) commands_->serve();
  }

  /// Learns who is there; returns the processes that are gone. Before the run has `begun`, this
  /// manager gives way to one that started earlier. Errors: kState (there is one).
  [[nodiscard]] Result<std::vector<std::uint64_t>> look_at_processes(bool begun);
  /// Whether that error was the reason: the run is another manager's.
  [[nodiscard]] bool is_second() const noexcept { return second_; }
  /// The host that a process said it serves; nothing: it did not say who it is, or does not fit.
  [[nodiscard]] std::optional<std::uint32_t> host_of(std::uint64_t writer) const;
  /// It has to say again who it is.
  void forget(std::uint64_t writer) { host_of_.erase(writer); }

  /// Takes in what hosts say of their robots.
  void take_roster(RosterBook& book, const Serving& serving) {
    read_roster(roster_, book, serving);
  }
  /// What hosts know of the run when it is over for them.
  [[nodiscard]] lock_step::FindingsCollector& findings() noexcept { return findings_; }
  void publish(bus::RunState& state) { static_cast<void>(states_.write(state)); }

  /// What its messages are signed with.
  [[nodiscard]] std::uint64_t writer() const noexcept { return bus_->writer(); }
  [[nodiscard]] const bus::Standstill& standstill() const noexcept { return bus_->standstill(); }
  /// How often this process stood still, in a run that had begun, for so long that others may have
  /// missed it.
  [[nodiscard]] std::uint64_t standstills() const noexcept { return standstills_; }
  /// For the log, of what another process has done wrong; it cannot fill the log with that.
  void log_fault(std::string_view text) { foreign_.write(LogLevel::kError, kSource, text); }

 private:
  struct Parts;
  explicit ManagerEndpoint(Parts parts);
  void meet(const bus::HostInfo& info, bool begun);

  lock_step::Identity identity_;
  bus::EventLog foreign_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<bus::RunState> states_;
  bus::Writer<bus::HostInfo> own_info_;
  bus::Reader<bus::HostInfo> infos_;
  bus::Reader<bus::RosterEntry> roster_;
  std::unique_ptr<bus::WishBox> wishes_;       ///< May be null.
  std::unique_ptr<bus::CommandBox> commands_;  ///< May be null.
  lock_step::Pulse pulse_;
  lock_step::FindingsCollector findings_;
  bus::HostInfo introduced_;                        ///< What the others are told of this process.
  std::map<std::uint64_t, std::uint32_t> host_of_;  ///< Of processes that fit.
  std::uint64_t standstills_ = 0;
  bool second_ = false;
};

}  // namespace rave::manager
