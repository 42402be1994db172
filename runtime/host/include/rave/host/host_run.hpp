// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/command_box.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/host/run.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/protocol/agreement.hpp"

namespace rave::runtime {

/// Configuration of a process that runs the robots of one host of a scenario.
struct HostOptions {
  RunOptions run;  ///< `picture`: write the data that it needs.
  bus::BusConfig bus;
  std::string host;  ///< Its name in the scenario.
  /// How long it waits for a missing environment manager: before the run and, in lock-step, after
  /// its loss. Then the robots are stopped and the recording is closed. 0: without limit.
  Duration manager_patience{};
  /// Where the drivers of the other hosts' robots are looked up while the scenario is built;
  /// unloaded afterwards. Null: in the catalogue of the run.
  std::unique_ptr<plugin::Catalogue> others;
  /// Begins a request to this host that arrived on the bus, in the calling thread; empty: such
  /// requests are refused.
  bus::BeginRequest begin_request;
  bus::BeginCommand begin_command;  ///< The same for orders (topic rave/command).
};

/// The outcome for this host. It writes result.json, events.log, scenario.yaml, results.cdr (from
/// which SharedResults makes the results of the whole run) and run.mcap, with the percepts and
/// commands of its robots and the poses of all.
struct HostOutcome {
  bool whole =
      false;  ///< It took part to the end, or until it was ended by hand, and lost nothing.
  std::string live_reason;  ///< Why the run was in real time; empty in lock-step.
  std::uint64_t steps = 0;
  /// The end of the run according to the environment manager, or to who ended this host by hand.
  std::string ending;
  std::vector<std::string> problems;  ///< One sentence each.
};

/// Runs the robots of one host in the calling thread.
///
/// In lock-step with the other hosts of the run, until its environment manager ends it. The host
/// waits for the manager, and after a loss for the next one. If the run has continued without this
/// host, its robots continue from their present poses.
///
/// In real time, if a driver of any robot is live or the scenario says so, until the duration of
/// the run has passed. The host waits for the manager before the start only. A host that joins late
/// begins in the middle of the run, with its simulated robots where the world shows them. A run
/// whose robots do not sense each other has no manager; then each host has its own time.
///
/// Errors: kNotFound (no such host in the scenario), what keeps a run from starting, what HostPort
/// and HostLink say, and what ends a run.
[[nodiscard]] Result<HostOutcome> run_host(const config::ExpandedScenario& scenario,
                                           plugin::Catalogue& catalogue, HostOptions options);

}  // namespace rave::runtime
