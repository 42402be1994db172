// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/event.hpp"

namespace rave::manager {

/// How a manager serves a run in real time.
struct LiveManagerOptions {
  bus::BusConfig bus;
  lock_step::Identity identity;  ///< `host` is kNone, `real_time` is set.
  std::string scenario;          ///< Its name, for people.
  std::vector<config::PlannedHost> hosts;
  /// All robots, by id.
  struct Robot {
    std::string name;
    Duration staleness;          ///< After which a robot that is not heard of counts as stale.
    bool simulated = true;       ///< At the start.
    bool twin = false;           ///< It has two sets of drivers.
    Duration other_staleness{};  ///< With its other set.
  };
  std::vector<Robot> robots;
  Duration step;          ///< Of the hosts; for who looks on.
  Duration duration;      ///< Of the run.
  Duration world_period;  ///< Above 0.
  /// How long the run waits for hosts that are not there, from when the first came.
  Duration host_timeout = from_seconds(10);
  /// The hosts belong to this process: when it is stopped, they are told to end.
  bool ends_hosts = false;
  /// Go on with a run that has lost its manager; else hosts whose run goes already are left alone.
  bool resume = false;
  /// By host, the command that starts it again when it is lost; empty: that is done without
  /// anybody.
  std::vector<std::string> commands;
  LogSink* log = nullptr;  ///< Not owned; may be null.
  /// Asked about ten times a second whether to end; may be empty.
  std::function<bool()> stopping;
  /// What others ask of the run; not owned, may be null.
  runtime::RunControl* control = nullptr;
  /// What is done with what others ask on the bus, in the calling thread; may be empty: they
  /// cannot.
  bus::BeginRequest begin_request;
  /// Told about ten times a second, in the calling thread: time of the run, simulated seconds per
  /// second of the slowest host, and for whom it waits; may be empty.
  std::function<void(SimTime, double, const std::string&)> on_progress;
  /// The world with all that came, when the run has ended; may be empty.
  std::function<void(const world::WorldModel&)> on_end;
};

/// What came of a run.
struct LiveManagerOutcome {
  bool whole = false;  ///< It went to its end here, with all hosts and all of its changes.
  SimTime end;         ///< Time of the run when this manager ended.
  std::uint64_t worlds = 0;
  std::uint64_t states = 0;  ///< Of hosts, that were taken in.
  struct Host {
    std::string name;
    bool heard = false;   ///< It was there at some time.
    double offset_s = 0;  ///< Clock of this process minus that of the host, as the host found.
    double bound_s = -1;  ///< Give or take this; below 0: not known.
    std::uint64_t losses = 0;
  };
  std::vector<Host> hosts;
  /// Changes of obstacles by hand, and how long it took from the request until the robots of all
  /// hosts had them around them, as far as hosts have confirmed that.
  struct Edits {
    std::uint64_t made = 0;
    std::uint64_t confirmed = 0;
    double slowest_s = 0;
    double sum_s = 0;  ///< Of all that were confirmed.
  };
  Edits edits;
  std::vector<sim::Event> refused;    ///< Changes of the scenario that could not be made.
  std::vector<std::string> problems;  ///< What else is wrong, one sentence each.
  /// What processes of hosts have sent of what they know; of all that were there at the end if
  /// `saw_off`: this manager stayed until the hosts had gone.
  std::vector<lock_step::HostResults> host_results;
  bool saw_off = false;
};

/// Serves a run in real time, in the calling thread: gives it its time, which is that of this
/// process since all hosts were there, gathers what hosts say of their robots, and tells all of
/// them each `world_period`. Of `spec` it has the obstacles and the bodies of the robots: it
/// decides which changes of obstacles can be made, those of the scenario and those by `control`,
/// and tells all at once. It resolves no motion and keeps nothing that hosts do not say again, so
/// it may be ended and started anew at any time: it then goes on with the time that the hosts have.
/// Whoever becomes late, lost or stale is in the log once and, for all processes, in the topics
/// `rave/world` and `rave/run`. Errors: the bus cannot be opened; kState (there is a manager of
/// this run already; hosts have lost theirs in the middle of a run that this one is not to
/// `resume`).
[[nodiscard]] Result<LiveManagerOutcome> manage_live(sim::EngineSpec spec,
                                                     const LiveManagerOptions& options);

}  // namespace rave::manager
