// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/manager/manager_run_options.hpp"
#include "rave/pace/lateness.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::manager {

/// Configuration of a manager for a world that several hosts share in lock-step.
struct ManagerOptions : ManagerRunOptions {
  std::uint64_t steps = 0;
  config::LostHost on_lost_host = config::LostHost::kWait;
  double pace = 0;  ///< Simulated seconds per second; 0: not limited.
  /// Passed to `on_progress` about ten times a second, in the calling thread.
  struct Progress {
    std::uint64_t step = 0;
    double speed = 0;     ///< Simulated seconds per second so far.
    std::string waiting;  ///< The hosts that it waits for; empty: none.
  };
  std::function<void(const Progress&)> on_progress{};
  /// Called with each world, also the last one, before the hosts get it; true: the run ends with
  /// it. May be empty.
  std::function<bool(const sim::WorldAuthority&)> on_world{};
  /// Called once with the final world. May be empty.
  std::function<void(const sim::WorldAuthority&)> on_end{};
};

/// The outcome of a run.
struct ManagerOutcome {
  bool whole = false;  ///< It reached its end, or was ended by hand, and no host was lost.
  bool ended_by_hand = false;
  std::uint64_t steps = 0;
  /// The run hash, equal to that of the run in one process; empty if a host was lost.
  std::optional<std::uint64_t> hash;
  runtime::LatenessFacts lateness;    ///< Missed deadlines of a run with a pace.
  double wall_s = 0;                  ///< From the first step to the last.
  std::vector<std::string> problems;  ///< One sentence each; empty if there are none.
  /// Results that processes of hosts have sent, by host.
  std::vector<lock_step::HostResults> host_results;
};

/// Manages the shared world of a run, from the first report to the last step, in the calling
/// thread. In each step it gathers the reports of all hosts, resolves the motion of all robots, and
/// sends the world, which starts the next step. It continues the run of an earlier manager from its
/// last step. Hosts that are missing, late or lost are treated as the policy says, with messages in
/// the log and, for all processes, in the topic `rave/run`. Requests for obstacles and robots
/// through `control` take effect in the next step, on all hosts. Errors: the bus cannot be opened;
/// kState (the run has a manager already; hosts have lost theirs during a run that is not to be
/// `resume`d; a host cannot continue and the policy is to wait); kInvalidArgument (the scenario).
[[nodiscard]] Result<ManagerOutcome> manage(sim::EngineSpec spec, const ManagerOptions& options);

}  // namespace rave::manager
