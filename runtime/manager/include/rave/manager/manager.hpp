// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/pace/lateness.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_authority.hpp"

namespace rave::manager {

/// How a manager runs a world that several hosts share in lock-step.
struct ManagerOptions {
  bus::BusConfig bus;
  lock_step::Identity identity;  ///< `host` is kNone.
  std::string scenario;          ///< Its name, for people.
  std::vector<config::PlannedHost> hosts;
  std::uint64_t steps = 0;
  config::LostHost on_lost_host = config::LostHost::kWait;
  Duration host_timeout = from_seconds(10);
  double pace = 0;  ///< Simulated seconds per second; 0: as fast as it can.
  /// Go on with a run that has lost its manager; else hosts beyond step 0 are left alone.
  bool resume = false;
  /// By host, the command that starts it again when it is lost; empty: that is done without
  /// anybody.
  std::vector<std::string> commands;
  LogSink* log = nullptr;  ///< Not owned; may be null.
  /// Asked about ten times a second whether to end the run; may be empty.
  std::function<bool()> stopping;
  /// What others ask of the run, and how they hold it; not owned, may be null.
  runtime::RunControl* control = nullptr;
  /// What is done with what others ask on the bus, in the calling thread; may be empty: they
  /// cannot.
  bus::BeginRequest begin_request;
  /// Told about ten times a second, in the calling thread; may be empty.
  struct Progress {
    std::uint64_t step = 0;
    double speed = 0;     ///< Simulated seconds per second so far.
    std::string waiting;  ///< For whom; empty while it goes.
  };
  std::function<void(const Progress&)> on_progress;
  /// Shown each world that was made, the last one included, before the hosts get it; true: the run
  /// has come to its end with it. May be empty.
  std::function<bool(const sim::WorldAuthority&)> on_world;
  /// Shown the world once more when none is made any more. May be empty.
  std::function<void(const sim::WorldAuthority&)> on_end;
};

/// What came of a run.
struct ManagerOutcome {
  bool whole = false;  ///< It went to its end, and no host was lost on the way.
  std::uint64_t steps = 0;
  /// Equal to that of the run in one process; nothing if a host was lost.
  std::optional<std::uint64_t> hash;
  std::uint64_t contacts = 0;         ///< That began.
  runtime::LatenessFacts lateness;    ///< Of a run with a pace.
  double wall_s = 0;                  ///< From the first step to the last.
  std::vector<std::string> problems;  ///< One sentence each; empty if all is well.
  /// What processes of hosts have sent of what they know, by host.
  std::vector<lock_step::HostResults> host_results;
};

/// Holds the world of a run for its hosts, from the first report to the last step, in the calling
/// thread: gathers the report of each host, limits the motion of all robots, and sends the world
/// back, which is the tick. If a manager of this run was there before, it goes on where that one
/// ended. Hosts are awaited, told apart and, when they are late or gone, treated as the policy
/// says; everything of that is in the log and, for all processes, in the topic `rave/run`. What is
/// asked of obstacles and robots by `control` counts from the next step on, on all hosts. Errors:
/// the bus cannot be opened; kState (there is a manager of this run already; hosts have lost theirs
/// in the middle of a run that this one is not to `resume`; a host cannot go on and the policy is
/// to wait); kInvalidArgument (the scenario).
[[nodiscard]] Result<ManagerOutcome> manage(sim::EngineSpec spec, const ManagerOptions& options);

}  // namespace rave::manager
