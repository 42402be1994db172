// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/report/progress.hpp"
#include "rave/results/run_outcome.hpp"

namespace rave::runtime {

class RunObserver;

/// How to run a scenario. What the command line overrides (seed, duration, threads, pace) is put
/// into the ExpandedScenario before.
struct RunOptions {
  /// Folder for everything that the run leaves; created. Files of an earlier run are replaced.
  std::filesystem::path output;
  std::filesystem::path program_runner;  ///< The executable for isolated programs.
  bool picture = true;                   ///< Draw picture.svg and picture.png.
  bool record = true;                    ///< Write run.mcap.
  LogSink* log = nullptr;                ///< Not owned; outlives the call.
  /// Called in the calling thread about ten times a second of wall time; may be empty.
  std::function<void(const report::Progress&)> on_progress;
  /// Additional observers of the run. Not owned; they outlive it.
  std::vector<RunObserver*> observers{};
  /// Pauses, steps and ends the run from elsewhere; may be null. Not owned.
  RunControl* control = nullptr;
  /// Arm all robots when the run starts. If false, robots with `arm: true` wait until a person arms
  /// them.
  bool arm = false;
  /// Name of the run for people who control it from elsewhere; only for messages.
  std::string run_name;
  /// Of one of several processes: the id of their run.
  std::string run_id{};
};

/// Runs a scenario to its end in the calling thread. Errors: a reason why it cannot start, and a
/// stepped driver that stops answering. A run that is only incomplete is no Error.
[[nodiscard]] Result<RunOutcome> run(const config::ExpandedScenario& scenario,
                                     plugin::Catalogue& catalogue, const RunOptions& options);

}  // namespace rave::runtime
