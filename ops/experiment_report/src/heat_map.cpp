// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot.hpp"
#include "plots.hpp"
#include "rave/experiment_report/answer.hpp"

namespace rave::experiment {
namespace {

constexpr double kCellWidth = 54;
constexpr double kCellHeight = 30;
constexpr double kCellsLeft = 150;

/// A colour between blue and yellow, two ends that people with any colour vision tell apart (after
/// cividis: Nunez, Anderton, Renslow, PLoS ONE 13, 2018).
std::string colour(double share) {
  const auto mix = [share](double a, double b) {
    return static_cast<int>(std::lround(a + (b - a) * share));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0x1d, 0xf3), mix(0x3c, 0xdf), mix(0x6e, 0x4e));
}

}  // namespace

std::string heat_map(const Analysis& analysis, const MetricAnalysis& metric) {
  const auto& experiment = analysis.plan.experiment;
  if (experiment.factors.size() != 2 || experiment.design != config::ExperimentDesign::kCrossed) {
    return "";
  }
  // Crossed: the second factor changes first.
  const auto& conditions = analysis.plan.conditions;
  std::size_t columns = 1;
  while (columns < conditions.size() &&
         conditions[columns].condition.levels[0] == conditions[0].condition.levels[0]) {
    ++columns;
  }
  const std::size_t rows = conditions.size() / columns;
  if (columns < 2 || rows < 2 || columns > 30 || rows > 30) return "";
  double low = 1e300;
  double high = -1e300;
  for (const MetricSummary& summary : metric.summaries) {
    if (!summary.centre) continue;
    low = std::min(low, summary.centre->estimate);
    high = std::max(high, summary.centre->estimate);
  }
  const auto& file = experiment.metrics[metric.metric];
  Plot plot(
      kCellsLeft + kCellWidth * static_cast<double>(columns) + 20,
      kCellHeight * static_cast<double>(rows) + 60,
      *file.name + " over " + *experiment.factors[0].name + " and " + *experiment.factors[1].name);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const double x = kCellsLeft + kCellWidth * static_cast<double>(c % columns);
    const double y = 8 + kCellHeight * static_cast<double>(c / columns);
    const auto& levels = conditions[c].condition.levels;
    if (c % columns == 0) plot.text(kCellsLeft - 8, y + 18, "end", "tick", levels[0]);
    if (c / columns == rows - 1)
      plot.text(x + kCellWidth / 2, y + kCellHeight + 16, "middle", "tick", levels[1]);
    const MetricSummary& summary = metric.summaries[c];
    if (!summary.centre) {
      plot.text(x + kCellWidth / 2, y + 18, "middle", "tick",
                summary.times.empty() ? "-" : "never");
      continue;
    }
    const double share = high > low ? (summary.centre->estimate - low) / (high - low) : 0;
    const bool best = metric.ranking.front() == c && file.better != config::MetricAim::kNone;
    plot.box(x + 1, y + 1, kCellWidth - 2, kCellHeight - 2,
             fmt::format("rx=\"3\" fill=\"{}\"{}", colour(share), best ? " class=\"best\"" : ""));
    plot.text(x + kCellWidth / 2, y + 18, "middle", share < 0.5 ? "on-dark" : "on-light",
              number_text(summary.centre->estimate));
  }
  const auto title = [](const config::FactorFile& factor) {
    return *factor.name + (factor.unit.empty() ? "" : ", " + factor.unit);
  };
  plot.text(kCellsLeft + kCellWidth * static_cast<double>(columns) / 2,
            kCellHeight * static_cast<double>(rows) + 46, "middle", "axis",
            title(experiment.factors[1]));
  plot.upright(16, 8 + kCellHeight * static_cast<double>(rows) / 2, title(experiment.factors[0]));
  return std::move(plot).svg();
}

}  // namespace rave::experiment
