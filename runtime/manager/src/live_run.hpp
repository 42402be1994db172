// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "live_edits.hpp"
#include "live_hosts.hpp"
#include "manager_run.hpp"
#include "rave/manager/live_manager.hpp"

namespace rave::manager {

/// One run in real time as its manager sees it, from the first host to the end. Belongs to one
/// thread.
class LiveRun final : ManagerRun {
 public:
  /// `options` are not owned.
  LiveRun(const LiveManagerOptions& options, std::unique_ptr<LiveHosts> hosts,
          std::unique_ptr<LiveEdits> edits)
      : ManagerRun(options, hosts->endpoint()),
        options_(options),
        hosts_(std::move(hosts)),
        edits_(std::move(edits)) {}

  [[nodiscard]] Result<LiveManagerOutcome> go();

 private:
  Status listen();
  void hear(const bus::ClockPing& ping);
  void take_over(std::int64_t run_ns);
  void leave_alone(std::int64_t run_ns);
  void begin_if_ready();
  void begin_in(std::chrono::nanoseconds lead);
  void send_world();
  void look_for_stale(SimTime now);
  void tell_silence(const std::vector<std::string_view>& names, std::string_view what);
  void tell_state(rave_wire_RunPhase phase, const std::string& text);
  void tell_progress();
  [[nodiscard]] bool ends_hosts() const;
  LiveManagerOutcome outcome();
  [[nodiscard]] SimTime now() const;
  [[nodiscard]] std::string missing() const;

  const LiveManagerOptions& options_;
  std::unique_ptr<LiveHosts> hosts_;
  std::unique_ptr<LiveEdits> edits_;  ///< Declared after the hosts, which it uses.
  std::int64_t zero_ns_ =
      0;  ///< Time 0 of the run by the clock of this machine; valid once the run has begun.
  std::chrono::steady_clock::time_point first_host_{};
  std::chrono::steady_clock::time_point next_world_{};
  std::chrono::steady_clock::time_point next_look_{};
  std::uint64_t worlds_ = 0;
  std::vector<std::uint8_t> stale_;  ///< By robot.
  bool ended_ = false;
  bool ended_by_hand_ = false;
  std::optional<Error>
      left_alone_;  ///< Hosts are in another run, which this manager does not continue.
};

}  // namespace rave::manager
