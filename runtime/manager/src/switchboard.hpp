// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/event_log.hpp"
#include "rave/bus/standstill.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/wish_box.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/findings.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/step_messages.hpp"
#include "roster_book.hpp"
#include "seats.hpp"

namespace rave::manager {

/// What the manager does with the bus. Belongs to one thread.
class Switchboard {
 public:
  /// `begin_wish` may be empty: nobody on the bus can ask anything. Errors: those of
  /// bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<Switchboard>> open(const bus::BusConfig& config,
                                                                 lock_step::Identity identity,
                                                                 LogSink* log,
                                                                 bus::BeginWish begin_wish);

  /// Sleeps until something has come, the time is over or `stop` is set.
  void wait(Duration timeout, const std::stop_token& stop = {}) {
    pulse_.beat({step_});
    static_cast<void>(waits_.wait(timeout, stop));
  }
  /// Begins what others ask on the bus, and answers what is done.
  void serve_wishes() {
    if (wishes_) wishes_->serve();
  }
  /// Learns who is there; returns the processes that are gone. Errors: kState (there is a manager
  /// that started earlier, and this one has not `begun`).
  [[nodiscard]] Result<std::vector<std::uint64_t>> look_at_processes(bool begun);
  /// Whether that error was the reason: the run is another manager's.
  [[nodiscard]] bool is_second() const noexcept { return second_; }
  [[nodiscard]] const bus::Standstill& standstill() const noexcept { return bus_->standstill(); }
  /// Whether a process said who it is, and fits.
  [[nodiscard]] bool knows(std::uint64_t writer) const { return fitting_.contains(writer); }

  /// Calls visit(const bus::HostReport&) for all that has come.
  template <class Visit>
  void take_reports(Visit&& visit) {
    reports_.take(std::forward<Visit>(visit));
  }
  /// Reads what a host hands over of the manager before into `world` and `authority` if it is newer
  /// than what is there; returns whether it was.
  bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority, bool has_one);
  /// Takes in what hosts say of their robots.
  void take_roster(RosterBook& book, const Serving& serving) {
    read_roster(roster_, book, serving);
  }
  void refuse(const bus::HostReport& report, std::string_view why) { reports_.refuse(report, why); }

  /// What hosts know of the run when it is over for them.
  [[nodiscard]] lock_step::FindingsCollector& findings() noexcept { return findings_; }

  /// Sends a step of the world, and remembers it for resend(). Errors: kInvalidArgument (larger
  /// than the bus carries).
  Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
              const std::vector<Seat>& seats);
  /// Sends the last one again, for a host that has not got it.
  void resend(const std::vector<Seat>& seats);
  void publish(bus::RunState& state) { static_cast<void>(states_.write(state)); }

 private:
  struct Parts;
  Status write(const std::vector<Seat>& seats);
  explicit Switchboard(Parts parts);

  lock_step::Identity identity_;
  bus::EventLog foreign_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<bus::WorldStep> worlds_;
  bus::Writer<bus::RunState> states_;
  bus::Writer<bus::HostInfo> own_info_;
  bus::Reader<bus::HostReport> reports_;
  bus::Reader<bus::LastWorld> last_worlds_;
  bus::Reader<bus::HostInfo> infos_;
  bus::Reader<bus::RosterEntry> roster_;
  std::unique_ptr<bus::WishBox> wishes_;  ///< May be null.
  bus::WaitSet waits_;
  bus::HostInfo introduced_;  ///< What the others were told of this process.
  lock_step::WorldMessage message_;
  bus::LastWorld* sent_ = nullptr;  ///< In `message_`.
  std::vector<std::uint64_t> writers_;
  std::uint64_t epoch_;
  lock_step::Pulse pulse_;
  lock_step::FindingsCollector findings_;
  std::uint64_t step_ = 0;  ///< That was sent last.
  std::set<std::uint64_t> fitting_;
  bool second_ = false;
};

}  // namespace rave::manager
