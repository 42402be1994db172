// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/experiment_file.hpp"
#include "rave/experiment/condition.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::experiment {

/// A condition whose scenario was built.
struct PlannedCondition {
  Condition condition;
  /// Digest of all that decides a run but its seed: the expanded scenario, its maps, the plug-ins
  /// that it uses, the program `rave`, and the metrics. The same wherever the files lie.
  std::string inputs;
  double duration_s = 0;  ///< Simulated time of a run, at most; 0: open end.
};

/// One run of a plan.
struct PlannedRun {
  std::size_t condition = 0;  ///< Index in Plan::conditions.
  std::uint64_t seed = 0;
};

/// An experiment, ready to run. A value.
struct Plan {
  config::ExperimentFile experiment;
  std::filesystem::path file;      ///< The experiment file.
  std::string text;                ///< Its content.
  std::filesystem::path scenario;  ///< The base scenario.
  std::vector<PlannedCondition> conditions;
  double pace = 0;  ///< Simulated by wall time of the first condition on one core; 0: not measured.

  /// By condition, and by seed in each: the order of tables.
  [[nodiscard]] std::vector<PlannedRun> runs() const;
  /// `speed=0.3, size=1`
  [[nodiscard]] std::string text_of(std::size_t condition) const {
    return condition_text(experiment, conditions[condition].condition);
  }
  /// The command that repeats a run, for a shell in the folder of the experiment file.
  [[nodiscard]] std::string command(const PlannedRun& run) const;
};

/// What a plan is made with.
struct PlanOptions {
  std::filesystem::path program;         ///< The executable `rave`.
  std::filesystem::path program_runner;  ///< For programs with `isolate: true`.
  /// Finds a scenario that is no file beside the experiment, by its name.
  std::function<Result<std::filesystem::path>(const std::string&)> find_scenario;
  double measure_s = 0;  ///< Wall time for which the pace is measured; 0: not at all.
};

/// Reads an experiment and builds the scenario of every condition, so that a wrong key or value is
/// found before the first run. Errors: those of the files; of a condition with its number and
/// values, at the place in the experiment file that it comes from; kInvalidArgument for a live run.
[[nodiscard]] Result<Plan> make_plan(const std::filesystem::path& file,
                                     plugin::Catalogue& catalogue, const PlanOptions& options);

}  // namespace rave::experiment
