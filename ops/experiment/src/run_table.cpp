// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/run_table.hpp"

#include <fmt/format.h>

#include <string_view>

namespace rave::experiment {
namespace {

std::string cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string head(const config::ExperimentFile& experiment) {
  std::string line = "condition";
  for (const auto& factor : experiment.factors) line += "," + *factor.name;
  line += ",seed,failure";
  for (const auto& metric : experiment.metrics) {
    line += "," + *metric.name;
    if (metric.time_to_event) line += "," + *metric.name + "_seen";
  }
  return line + ",simulated_s,hash,command\n";
}

void add_metrics(const config::ExperimentFile& experiment, const RunRow& row, std::string& line) {
  for (std::size_t m = 0; m < experiment.metrics.size(); ++m) {
    const bool timed = experiment.metrics[m].time_to_event;
    if (row.values.size() <= m) {
      line += timed ? ",," : ",";
    } else if (row.values[m]) {
      line += fmt::format(",{:.12g}{}", *row.values[m], timed ? ",1" : "");
    } else {
      line += timed ? fmt::format(",{:.12g},0", row.simulated_s) : ",";
    }
  }
}

}  // namespace

std::string run_table(const Plan& plan, const RunRows& rows) {
  std::string text = head(plan.experiment);
  for (const PlannedRun& run : plan.runs()) {
    const PlannedCondition& condition = plan.conditions[run.condition];
    const RunRow* const row = rows.find(condition.inputs, run.seed);
    if (row == nullptr) continue;
    text += fmt::format("{}", run.condition + 1);
    for (const std::string& level : condition.condition.levels) text += "," + cell(level);
    text += fmt::format(",{},{}", run.seed, cell(row->failure));
    add_metrics(plan.experiment, *row, text);
    text += fmt::format(",{:.12g},{},{}\n", row->simulated_s, row->hash, cell(plan.command(run)));
  }
  return text;
}

}  // namespace rave::experiment
