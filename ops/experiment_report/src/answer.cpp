// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rave::experiment {
namespace {

std::string with_unit(double value, const config::MetricFile& metric) {
  return number_text(value) + (metric.unit.empty() ? "" : " " + metric.unit);
}

std::string p_equation(double p) { return (p < 0.001 ? "p " : "p = ") + p_text(p); }

/// `with speed=0.5 (half by 15.2 s, 7 of 20)`
std::string timed_side(const Analysis& analysis, std::size_t metric, std::size_t condition) {
  const MetricSummary& summary = analysis.metrics[metric].summaries[condition];
  const auto& file = analysis.plan.experiment.metrics[metric];
  const std::string half = summary.centre ? "half by " + with_unit(summary.centre->estimate, file)
                                          : "never half of them";
  return fmt::format("{} ({}, {} of {} at all)", analysis.plan.text_of(condition), half,
                     summary.values.size(), summary.times.size());
}

}  // namespace

std::string number_text(double value) {
  if (value == 0) return "0";
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  std::string text = fmt::format("{:.{}f}", value, std::clamp(3 - before, 0, 8));
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string p_text(double p) {
  if (p < 0.001) return "< 0.001";
  return fmt::format("{:.{}f}", p, p < 0.1 ? 3 : 2);
}

std::string metric_title(const config::MetricFile& metric) {
  return *metric.name + (metric.unit.empty() ? "" : ", " + metric.unit);
}

std::string centre_text(const MetricSummary& summary, bool timed) {
  if (summary.centre) return number_text(summary.centre->estimate);
  return timed && !summary.times.empty() ? "not by half" : "";
}

std::string spread_text(const MetricSummary& summary, bool timed) {
  if (timed) return fmt::format("{} of {}", summary.values.size(), summary.times.size());
  if (!summary.centre) return "";
  return number_text(summary.centre->low) + " to " + number_text(summary.centre->high);
}

std::string sentence(const Analysis& analysis, const ComparisonAnalysis& comparison) {
  const auto& metric = analysis.plan.experiment.metrics[comparison.metric];
  const std::string one = analysis.plan.text_of(comparison.condition);
  const std::string other = analysis.plan.text_of(comparison.against);
  const bool less = comparison.outcome == config::ComparisonOutcome::kLess;
  const bool none = comparison.outcome == config::ComparisonOutcome::kNoDifference;
  if (comparison.test == ComparisonTest::kLogRank) {
    const char* const how = none ? "no difference is shown between"
                            : comparison.outcome == config::ComparisonOutcome::kMore
                                ? "it comes later with"
                                : "it comes earlier with";
    return fmt::format("{}: {} {} {} {}; log-rank test, {}.", *metric.name, how,
                       timed_side(analysis, comparison.metric, comparison.condition),
                       none ? "and" : "than with",
                       timed_side(analysis, comparison.metric, comparison.against),
                       p_equation(comparison.corrected));
  }
  std::string size;
  if (comparison.difference) {
    // A size with its interval beside `less`, and a difference with its sign where none is shown.
    const double difference = comparison.difference->estimate;
    size = with_unit(less ? -difference : difference, metric);
    if (!comparison.differences.empty()) {
      size +=
          fmt::format(" (95 % interval {} to {}, {} pairs of seeds)",
                      number_text(less ? -comparison.difference->high : comparison.difference->low),
                      number_text(less ? -comparison.difference->low : comparison.difference->high),
                      comparison.differences.size());
    }
  }
  if (none) {
    return fmt::format("{}: no difference is shown between {} and {}, {}; {}.", *metric.name, one,
                       other, size, p_equation(comparison.corrected));
  }
  return fmt::format("{}: {} has {} {} than {}; {}.", *metric.name, one, size,
                     text_of(comparison.outcome), other, p_equation(comparison.corrected));
}

std::string answer(const Analysis& analysis) {
  if (!analysis.comparisons.empty()) return sentence(analysis, analysis.comparisons.front());
  const MetricAnalysis& first = analysis.metrics.front();
  const auto& metric = analysis.plan.experiment.metrics[first.metric];
  const std::size_t best = first.ranking.front();
  const MetricSummary& summary = first.summaries[best];
  const std::string value = centre_text(summary, metric.time_to_event);
  return fmt::format("{}: {} with {}{}. No comparison was named before the runs.", *metric.name,
                     value.empty() ? "unknown" : value, analysis.plan.text_of(best),
                     metric.better == config::MetricAim::kNone ? "" : ", the best condition");
}

}  // namespace rave::experiment
