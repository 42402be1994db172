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

/// How a process runs the robots of one host of a scenario.
struct HostOptions {
  RunOptions run;  ///< `picture`: leave what it needs.
  bus::BusConfig bus;
  std::string host;  ///< Its name in the scenario.
  /// How long it waits for an environment manager that is not there, before the run and, in
  /// lock-step, when that is gone; then its robots are stopped and the record is closed. 0: without
  /// limit.
  Duration manager_patience{};
  /// Where the drivers of the other hosts' robots are looked up while the scenario is built;
  /// unloaded afterwards. Null: in the catalogue of the run.
  std::unique_ptr<plugin::Catalogue> others;
  /// What is done with what others ask of this host on the bus, in the calling thread; may be
  /// empty: they cannot.
  bus::BeginRequest begin_request;
  bus::OnCommand on_command;  ///< The same of commands.
};

/// How it ended for this host. It leaves result.json, events.log, scenario.yaml, results.cdr
/// (of which the results of the whole run are made, SharedResults) and run.mcap, whose percepts and
/// commands are of its robots, and whose poses are of all.
struct HostOutcome {
  bool whole = false;       ///< It took part from the first step to the last, and lost no driver.
  std::string live_reason;  ///< Why the run was in real time; empty in lock-step.
  std::uint64_t steps = 0;
  std::string ending;                 ///< What the environment manager says of the run.
  std::vector<std::string> problems;  ///< One sentence each.
};

/// Runs the robots of one host in the calling thread.
///
/// In lock-step with the other hosts of the run, until its environment manager says that it is
/// over. It waits for the manager, and if that is lost for one that takes its place; in a run that
/// went on without it its robots go on where they stand.
///
/// In real time, if a driver of any robot is live or the scenario says so, until the time of the
/// run is over. It waits for the manager before it starts and for nobody afterwards. A host that
/// comes late begins in the middle of the run; its simulated robots stand where the world shows
/// them. A run in which nobody looks at others has no manager; then each host has a time of its
/// own.
///
/// Errors: kNotFound (no such host in the scenario), what keeps a run from starting, what HostPort
/// and HostLink say, and what ends a run.
[[nodiscard]] Result<HostOutcome> run_host(const config::ExpandedScenario& scenario,
                                           plugin::Catalogue& catalogue, HostOptions options);

}  // namespace rave::runtime
