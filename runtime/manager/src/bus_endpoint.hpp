// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "manager_endpoint.hpp"
#include "manager_habits.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/event_log.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/standstill.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/manager/manager_run_options.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/pulse.hpp"

namespace rave::manager {

/// The endpoint of a manager whose run is on the bus. Belongs to one thread.
class BusEndpoint final : public ManagerEndpoint {
 public:
  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<BusEndpoint>> open(const ManagerRunOptions& options);

  /// The bus, for the topics that only one kind of run has.
  [[nodiscard]] bus::Bus& bus() noexcept { return *bus_; }
  /// Wakes `waits` when results or requests come.
  Status wake(bus::WaitSet& waits);
  /// Wakes `waits` also when processes appear or leave; then look_at_processes() is due after each
  /// wait.
  Status wake_for_processes(bus::WaitSet& waits);
  /// Announces this manager to the other processes. Call it when all readers for their answers
  /// exist.
  Status introduce();
  /// Sleeps until a message arrives, the time has passed or `stop` is set. `step`: of the run.
  void wait(bus::WaitSet& waits, std::uint64_t step, Duration timeout,
            const std::stop_token& stop) {
    pulse_.beat({step});
    static_cast<void>(waits.wait(timeout, stop));
  }

  void serve_requests() override {
    if (requests_) requests_->serve();
  }
  Result<std::vector<std::uint64_t>> look_at_processes(bool begun) override;
  bool is_second() const override { return second_; }
  std::optional<std::uint32_t> host_of(std::uint64_t writer) const override;
  void take_roster(RosterBook& book, const Serving& serving) override {
    read_roster(roster_, book, serving);
  }
  void take_host_results(const std::function<bool(std::uint64_t, std::uint32_t)>& served) override {
    host_results_.take(served);
  }
  bool owes_host_results(std::uint64_t writer) const override {
    return !host_results_.done_with(writer);
  }
  std::vector<lock_step::HostResults> hand_out_host_results() override {
    return host_results_.hand_out();
  }
  void publish(bus::RunState& state) override { static_cast<void>(states_.write(state)); }
  std::uint64_t writer() const override { return bus_->writer(); }
  std::chrono::steady_clock::time_point silence_counts_from() const override {
    return bus_->standstill().silence_counts_from();
  }
  std::uint64_t standstills() const override { return standstills_; }
  void log_fault(std::string_view text) override {
    foreign_.write(LogLevel::kError, kSource, text);
  }

 private:
  BusEndpoint(lock_step::Identity identity, LogSink* log)
      : identity_(std::move(identity)),
        foreign_(log),
        introduced_(lock_step::introduction(identity_)) {}
  void meet(const bus::HostInfo& info, bool begun);

  lock_step::Identity identity_;
  bus::EventLog foreign_;
  std::unique_ptr<bus::Bus> bus_;
  bus::Writer<bus::RunState> states_;
  bus::Writer<bus::HostInfo> own_info_;
  bus::Reader<bus::HostInfo> infos_;
  bus::Reader<bus::RosterEntry> roster_;
  std::unique_ptr<bus::RequestBox> requests_;  ///< May be null.
  lock_step::Pulse pulse_;
  lock_step::HostResultsCollector host_results_;
  bus::HostInfo introduced_;  ///< What this process tells the others about itself.
  std::map<std::uint64_t, std::uint32_t> host_of_;  ///< By process, for those that fit this run.
  std::uint64_t standstills_ = 0;
  bool second_ = false;
};

}  // namespace rave::manager
