// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/launch/run_settings.hpp"
#include "rave/report/progress.hpp"
#include "rave/results/shared_results.hpp"

namespace rave::launch {

/// A run whose environment manager is this process.
struct ManagedRun {
  const config::ExpandedScenario& scenario;
  const RunSettings& settings;
  const bus::BusConfig& bus;
  std::filesystem::path folder;  ///< Gets scenario.yaml and, of ManagedEnd::results, the rest.
  LogSink& log;
  runtime::RunControl& control;  ///< What others ask of the run.
  std::function<bool()> stopping;
  /// Set: the hosts belong to this process; whether all of them have ended.
  std::function<bool()> hosts_ended{};
  /// Continue a run that has lost its manager; under the policy `restart` in any case.
  bool resume = false;
  /// Called now and then in the calling thread; may be empty.
  std::function<void(const report::Progress&)> on_progress{};
};

/// The world of a scenario alone: what its robots do is for their hosts. No plug-in stays loaded.
[[nodiscard]] Result<runtime::BuiltScenario> build_world(const config::ExpandedScenario& scenario,
                                                         const RunSettings& settings, LogSink& log);

/// Whether this number of hosts can find each other in this run, before any of them starts. Errors:
/// kInvalidArgument (too many for real time), those of runtime::build().
[[nodiscard]] Status check_hosts_fit(const config::ExpandedScenario& scenario,
                                     const RunSettings& settings, std::size_t hosts, LogSink& log);

/// How it ended.
struct ManagedEnd {
  bool live = false;  ///< It was in real time.
  runtime::SharedEnd end;
  /// To be written when it is known where the hosts left what they know.
  std::unique_ptr<runtime::SharedResults> results;
};

/// Builds the world, waits for the hosts and manages the run to its end, in lock-step or in real
/// time. No plug-in stays loaded while it goes. A run in real time in which no robot needs the
/// poses of others is not managed: with hosts of this process it waits for their end. Errors:
/// kInvalidArgument (not managed, and no hosts here), those of runtime::build(), manager::manage()
/// and manager::manage_live().
[[nodiscard]] Result<ManagedEnd> manage_run(const ManagedRun& run);

}  // namespace rave::launch
