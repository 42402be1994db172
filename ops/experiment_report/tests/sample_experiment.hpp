// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "rave/experiment_report/analysis.hpp"

namespace rave::experiment {

/// A plan of an experiment with two metrics, `way` and the time to an event `caught`.
inline Plan sample_plan(const std::string& factors, int repetitions,
                        const std::string& comparisons) {
  Plan plan;
  plan.experiment = *config::read_experiment_text(
      "name: study\nquestion: Is <fast> far & good?\nscenario: room.yaml\nrepetitions: " +
          std::to_string(repetitions) + "\nfactors: [" + factors +
          "]\nmetrics:\n  - {name: way, value: way, unit: m, better: more}\n"
          "  - {name: caught, value: t, unit: s, time_to_event: true, better: less}\n"
          "comparisons: [" +
          comparisons + "]\n",
      "e.yaml");
  for (Condition& condition : conditions_of(plan.experiment)) {
    const std::string inputs = condition_text(plan.experiment, condition);
    plan.conditions.push_back({std::move(condition), inputs, 60});
  }
  return plan;
}

/// Rows of all runs of a plan, each of 60 s; `values` of condition and seed.
inline RunRows sample_rows(
    const Plan& plan,
    const std::function<std::vector<std::optional<double>>(std::size_t, std::uint64_t)>& values) {
  RunRows rows;
  for (const PlannedRun& run : plan.runs()) {
    RunRow row{plan.conditions[run.condition].inputs,
               run.seed,
               "",
               values(run.condition, run.seed),
               60,
               "00",
               1};
    if (row.values.empty()) row.failure = "it <crashed>";
    rows.add(row);
  }
  return rows;
}

}  // namespace rave::experiment
