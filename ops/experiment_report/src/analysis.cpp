// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include "rave/base/hash.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/statistics/rank_tests.hpp"

namespace rave::experiment {
namespace {

using config::ComparisonOutcome;
using statistics::Interval;

/// Later than any time: a time to an event that was not seen, in rankings.
constexpr double kNever = 1e300;

class Analyst {
 public:
  Analyst(const Plan& plan, const RunRows& rows) : plan_(plan), rows_(rows) {}

  [[nodiscard]] const RunRow* row(std::size_t condition, std::uint64_t seed) const {
    return rows_.find(plan_.conditions[condition].inputs, seed);
  }

  /// The value of a whole run; empty: unknown or not seen.
  [[nodiscard]] std::optional<double> value(std::size_t metric, std::size_t condition,
                                            std::uint64_t seed) const {
    const RunRow* const run = row(condition, seed);
    if (run == nullptr || run->values.size() <= metric) return std::nullopt;
    return run->values[metric];
  }

  [[nodiscard]] MetricSummary summary(std::size_t metric, std::size_t condition) const {
    MetricSummary summary;
    summary.condition = condition;
    const bool timed = plan_.experiment.metrics[metric].time_to_event;
    for (const std::uint64_t seed : seeds()) {
      const RunRow* const run = row(condition, seed);
      if (run == nullptr || run->values.size() <= metric) continue;
      const auto& number = run->values[metric];
      if (number) summary.values.push_back(*number);
      if (timed) {
        summary.times.push_back({number.value_or(run->simulated_s), number.has_value()});
      } else if (!number) {
        ++summary.unknown;
      }
    }
    if (timed) {
      const auto median = statistics::median_time(statistics::kaplan_meier(summary.times));
      if (median) summary.centre = Interval{*median, *median, *median};
    } else if (!summary.values.empty()) {
      summary.centre = statistics::bootstrap(summary.values, statistics::Centre::kMean);
    }
    return summary;
  }

  [[nodiscard]] MetricAnalysis metric(std::size_t index) const {
    MetricAnalysis analysis;
    analysis.metric = index;
    for (std::size_t c = 0; c < plan_.conditions.size(); ++c) {
      analysis.summaries.push_back(summary(index, c));
    }
    analysis.ranking.resize(plan_.conditions.size());
    std::iota(analysis.ranking.begin(), analysis.ranking.end(), 0);
    const auto aim = plan_.experiment.metrics[index].better;
    if (aim == config::MetricAim::kNone) return analysis;
    const bool timed = plan_.experiment.metrics[index].time_to_event;
    const double sign = aim == config::MetricAim::kLess ? 1 : -1;
    std::ranges::stable_sort(analysis.ranking, {}, [&](std::size_t c) {
      const MetricSummary& one = analysis.summaries[c];
      if (one.values.empty() && one.times.empty()) return kNever;
      // Of conditions in which more than half never saw the event, those with the fewest events
      // are the latest.
      const double share = static_cast<double>(one.values.size()) /
                           std::max(1.0, static_cast<double>(one.times.size()));
      if (timed && !one.centre) return sign * (1e9 + 1 - share);
      return sign * one.centre->estimate;
    });
    return analysis;
  }

  [[nodiscard]] ComparisonAnalysis compare(std::size_t metric, std::size_t condition,
                                           std::size_t against) const {
    ComparisonAnalysis result;
    result.metric = metric;
    result.condition = condition;
    result.against = against;
    if (plan_.experiment.metrics[metric].time_to_event) {
      compare_times(result);
    } else {
      compare_values(result);
    }
    return result;
  }

  [[nodiscard]] std::vector<std::uint64_t> seeds() const {
    std::vector<std::uint64_t> seeds(static_cast<std::size_t>(plan_.experiment.repetitions));
    std::iota(seeds.begin(), seeds.end(), plan_.experiment.first_seed);
    return seeds;
  }

 private:
  void compare_times(ComparisonAnalysis& result) const {
    result.test = ComparisonTest::kLogRank;
    const auto test = statistics::log_rank(summary(result.metric, result.condition).times,
                                           summary(result.metric, result.against).times);
    result.p = test.p;
    // Fewer events than expected: they come later.
    result.outcome = test.statistic < 0 ? ComparisonOutcome::kMore : ComparisonOutcome::kLess;
  }

  void compare_values(ComparisonAnalysis& result) const {
    for (const std::uint64_t seed : seeds()) {
      const auto a = value(result.metric, result.condition, seed);
      const auto b = value(result.metric, result.against, seed);
      if (a && b) result.differences.push_back(*a - *b);
    }
    double centre = 0;
    if (result.differences.empty()) {
      const auto a = summary(result.metric, result.condition);
      const auto b = summary(result.metric, result.against);
      result.test = ComparisonTest::kMannWhitney;
      result.p = statistics::mann_whitney(a.values, b.values).p;
      if (a.centre && b.centre) {
        centre = a.centre->estimate - b.centre->estimate;
        result.difference = Interval{centre, centre, centre};
      }
    } else {
      result.p = statistics::wilcoxon(result.differences).p;
      result.difference = statistics::bootstrap(result.differences, statistics::Centre::kMean);
      centre = result.difference->estimate;
      const double spread = statistics::standard_deviation(result.differences);
      if (spread > 0) result.effect = centre / spread;
    }
    result.outcome = centre < 0 ? ComparisonOutcome::kLess : ComparisonOutcome::kMore;
  }

  const Plan& plan_;
  const RunRows& rows_;
};

/// The levels of one side of a comparison by factor; empty: any.
std::vector<std::string> side_of(const config::ExperimentFile& experiment,
                                 const std::map<std::string, codec::RawNode>& side) {
  std::vector<std::string> levels;
  for (const config::FactorFile& factor : experiment.factors) {
    const auto found = side.find(*factor.name);
    levels.push_back(found == side.end()         ? ""
                     : found->second.is_scalar() ? found->second.scalar()
                                                 : codec::to_json_line(found->second));
  }
  return levels;
}

/// The condition with the levels of `side`, and those of `condition` where it has none.
std::optional<std::size_t> counterpart(const Plan& plan, std::vector<std::string> side,
                                       std::size_t condition) {
  for (std::size_t f = 0; f < side.size(); ++f) {
    if (side[f].empty()) side[f] = plan.conditions[condition].condition.levels[f];
  }
  for (std::size_t c = 0; c < plan.conditions.size(); ++c) {
    if (plan.conditions[c].condition.levels == side) return c;
  }
  return std::nullopt;
}

bool matches(const std::vector<std::string>& levels, const std::vector<std::string>& side) {
  for (std::size_t f = 0; f < side.size(); ++f) {
    if (!side[f].empty() && side[f] != levels[f]) return false;
  }
  return true;
}

Status add_comparison(const config::ComparisonFile& file, const Analyst& analyst,
                      Analysis& analysis) {
  const auto& experiment = analysis.plan.experiment;
  const auto metric =
      std::ranges::find(experiment.metrics, *file.metric, [](const auto& m) { return *m.name; });
  const auto index = static_cast<std::size_t>(metric - experiment.metrics.begin());
  const auto side = side_of(experiment, file.condition);
  bool found = false;
  for (std::size_t c = 0; c < analysis.plan.conditions.size(); ++c) {
    if (!matches(analysis.plan.conditions[c].condition.levels, side)) continue;
    const auto other = counterpart(analysis.plan, side_of(experiment, file.against), c);
    if (!other || *other == c) continue;
    found = true;
    analysis.comparisons.push_back(analyst.compare(index, c, *other));
    analysis.comparisons.back().expected = file.expect;
  }
  if (found) return {};
  return fail_at(file.metric.where, ErrorCode::kInvalidArgument,
                 "no two conditions of the design fit this comparison");
}

void correct(std::vector<ComparisonAnalysis>& comparisons) {
  std::vector<double> p;
  for (const auto& comparison : comparisons) p.push_back(comparison.p);
  const std::vector<double> corrected = statistics::holm(p);
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    comparisons[i].corrected = corrected[i];
    if (corrected[i] >= kSignificance) comparisons[i].outcome = ComparisonOutcome::kNoDifference;
  }
}

}  // namespace

bool Analysis::as_expected() const {
  return std::ranges::all_of(comparisons, &ComparisonAnalysis::as_expected);
}

Result<Analysis> analyse(Plan plan, const RunRows& rows) {
  Analysis analysis;
  analysis.plan = std::move(plan);
  const Analyst analyst(analysis.plan, rows);
  std::string hashes;
  for (const PlannedRun& run : analysis.plan.runs()) {
    ++analysis.planned;
    const RunRow* const row = analyst.row(run.condition, run.seed);
    if (row == nullptr) continue;
    ++analysis.runs;
    hashes += row->hash + "\n";
    if (!row->failure.empty()) analysis.failed.push_back({run, row->failure});
  }
  if (analysis.runs == 0) {
    return fail(ErrorCode::kNotFound, "no run of `{}` is finished", *analysis.plan.experiment.name);
  }
  analysis.digest =
      fmt::format("{:016x}", content_hash(std::as_bytes(std::span(hashes.data(), hashes.size()))));
  for (std::size_t m = 0; m < analysis.plan.experiment.metrics.size(); ++m) {
    analysis.metrics.push_back(analyst.metric(m));
  }
  for (const config::ComparisonFile& file : analysis.plan.experiment.comparisons) {
    RAVE_TRY(add_comparison(file, analyst, analysis));
  }
  correct(analysis.comparisons);
  return analysis;
}

const char* text_of(ComparisonOutcome outcome) {
  switch (outcome) {
    case ComparisonOutcome::kLess:
      return "less";
    case ComparisonOutcome::kMore:
      return "more";
    case ComparisonOutcome::kNoDifference:
      break;
  }
  return "no difference shown";
}

}  // namespace rave::experiment
