// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/manager/manager_run_options.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/event.hpp"

namespace rave::manager {

/// Configuration of a manager for a run in real time.
struct LiveManagerOptions : ManagerRunOptions {
  /// All robots, by id.
  struct Robot {
    std::string name;
    Duration staleness;          ///< Time without a report after which it is stale.
    bool simulated = true;       ///< At the start.
    bool twin = false;           ///< It has two sets of drivers.
    Duration other_staleness{};  ///< Staleness with its other set of drivers.
  };
  std::vector<Robot> robots{};
  Duration step{};          ///< Step of the hosts; for observers.
  Duration duration{};      ///< Duration of the run.
  Duration world_period{};  ///< Above 0.
  /// This process owns the hosts: when it is stopped, it tells them to end.
  bool ends_hosts = false;
  /// Called about ten times a second, in the calling thread, with the time of the run, the
  /// simulated seconds per second of the slowest host, and the hosts that it waits for; may be
  /// empty.
  std::function<void(SimTime, double, const std::string&)> on_progress{};
  /// Called with the final world, with added obstacles; may be empty.
  std::function<void(const world::WorldModel&)> on_end{};
};

/// The outcome of a run.
struct LiveManagerOutcome {
  bool whole =
      false;  ///< It reached its end under this manager, with all hosts and all of its changes.
  bool ended_by_hand = false;  ///< The run, not only this manager.
  SimTime end;                 ///< Time of the run when this manager ended.
  std::uint64_t worlds = 0;
  std::uint64_t states = 0;  ///< Number of reports received from hosts.
  struct Host {
    std::string name;
    bool heard = false;  ///< It was present at some time.
    double offset_s =
        0;  ///< Clock of this process minus that of the host, as the host measured it.
    double bound_s = -1;  ///< Bound of the error of offset_s; below 0: unknown.
    std::uint64_t losses = 0;
  };
  std::vector<Host> hosts;
  /// Changes of obstacles by hand, and the time from the request until the robots of all hosts
  /// sensed them, as far as hosts have confirmed that.
  struct Edits {
    std::uint64_t made = 0;
    std::uint64_t confirmed = 0;
    double slowest_s = 0;
    double sum_s = 0;  ///< Sum over all confirmed changes.
  };
  Edits edits;
  std::vector<sim::Event> refused;    ///< Changes of the scenario that could not be made.
  std::vector<std::string> problems;  ///< Other problems, one sentence each.
  /// Results that hosts have sent. With `drained` they include those of every host that was present
  /// at the end.
  std::vector<lock_step::HostResults> host_results;
  bool drained = false;  ///< This manager stayed until all hosts had left.
};

/// Manages a run in real time, in the calling thread. Its time 0 is when all hosts are present, by
/// the clock of this process. It gathers the reports of hosts and publishes all poses every
/// `world_period`. It decides which changes of obstacles can be made, those of the scenario and
/// those through `control`, and sends them to all hosts; for this it uses the obstacles and the
/// bodies of `spec`. It resolves no motion and keeps nothing that hosts do not report again. So it
/// may be ended and restarted at any time, and then continues with the time that the hosts have.
/// Robots and hosts that become late, lost or stale are in the log once and, for all processes, in
/// the topics `rave/world` and `rave/run`. Errors: the bus cannot be opened; kState (the run has a
/// manager already; hosts have lost theirs during a run that is not to be `resume`d).
[[nodiscard]] Result<LiveManagerOutcome> manage_live(sim::EngineSpec spec,
                                                     const LiveManagerOptions& options);

}  // namespace rave::manager
