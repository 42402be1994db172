// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/summary.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "rave/base/table.hpp"
#include "rave/experiment_report/answer.hpp"

namespace rave::experiment {
namespace {

constexpr std::size_t kMostSummaryRows = 20;

Table table_of(const Analysis& analysis, const MetricAnalysis& metric) {
  const auto& file = analysis.plan.experiment.metrics[metric.metric];
  const bool timed = file.time_to_event;
  Table table;
  table.title = metric_title(file);
  table.columns = {{"condition", Align::kLeft, true},
                   {timed ? "median" : "mean", Align::kRight},
                   {timed ? "seen in" : "95 % interval", Align::kRight},
                   {"runs", Align::kRight}};
  for (const std::size_t c : metric.ranking) {
    if (table.rows.size() == kMostSummaryRows) break;
    const MetricSummary& summary = metric.summaries[c];
    const std::size_t runs = timed ? summary.times.size() : summary.values.size();
    table.rows.push_back({analysis.plan.text_of(c), centre_text(summary, timed),
                          spread_text(summary, timed), std::to_string(runs)});
  }
  return table;
}

std::string cell(std::string text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string report_summary(const Analysis& analysis, std::optional<std::size_t> width,
                           bool colours) {
  const auto& experiment = analysis.plan.experiment;
  std::string text = (experiment.question.empty() ? *experiment.name : experiment.question) + "\n";
  text += answer(analysis) + "\n\n";
  TableOptions options;
  options.width = width;
  options.ansi = colours;
  for (const MetricAnalysis& metric : analysis.metrics) {
    text += render_table(table_of(analysis, metric), options);
    if (metric.ranking.size() > kMostSummaryRows) {
      text += fmt::format("and {} more conditions\n", metric.ranking.size() - kMostSummaryRows);
    }
  }
  for (const ComparisonAnalysis& comparison : analysis.comparisons) {
    const Tone tone = comparison.as_expected() ? Tone::kGood : Tone::kBad;
    const std::string verdict = !comparison.expected ? ""
                                : comparison.as_expected()
                                    ? " As expected."
                                    : fmt::format(" Expected: {}.", text_of(*comparison.expected));
    text += sentence(analysis, comparison) + toned(verdict, tone, colours) + "\n";
  }
  if (!analysis.failed.empty()) {
    text += fmt::format("{} of {} runs failed; they count nowhere.\n", analysis.failed.size(),
                        analysis.runs);
  }
  if (analysis.runs < analysis.planned) {
    text += fmt::format("{} of {} runs are missing.\n", analysis.planned - analysis.runs,
                        analysis.planned);
  }
  return text;
}

std::string condition_table(const Analysis& analysis) {
  const auto& experiment = analysis.plan.experiment;
  std::string text = "condition";
  for (const auto& factor : experiment.factors) text += "," + *factor.name;
  text += ",metric,runs,seen,centre,low,high\n";
  for (const MetricAnalysis& metric : analysis.metrics) {
    const auto& file = experiment.metrics[metric.metric];
    for (const MetricSummary& summary : metric.summaries) {
      text += std::to_string(summary.condition + 1);
      for (const auto& level : analysis.plan.conditions[summary.condition].condition.levels) {
        text += "," + cell(level);
      }
      const std::size_t runs =
          file.time_to_event ? summary.times.size() : summary.values.size() + summary.unknown;
      text += fmt::format(",{},{},{}", *file.name, runs, summary.values.size());
      if (!summary.centre) {
        text += ",,,\n";
      } else if (file.time_to_event) {
        text += fmt::format(",{:.12g},,\n", summary.centre->estimate);
      } else {
        text += fmt::format(",{:.12g},{:.12g},{:.12g}\n", summary.centre->estimate,
                            summary.centre->low, summary.centre->high);
      }
    }
  }
  return text;
}

}  // namespace rave::experiment
