// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "plot.hpp"
#include "plots.hpp"
#include "rave/experiment_report/answer.hpp"

namespace rave::experiment {
namespace {

constexpr double kCurvesWidth = 640;
constexpr double kCurvesLeft = 54;
constexpr double kCurvesRight = 440;
constexpr double kCurvesBottom = 250;
constexpr std::size_t kMostCurves = 6;

/// At most kMostCurves conditions: the first, the last, and those between at equal distances.
std::vector<std::size_t> chosen(const std::vector<std::size_t>& ranking) {
  if (ranking.size() <= kMostCurves) return ranking;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < kMostCurves; ++i) {
    some.push_back(ranking[i * (ranking.size() - 1) / (kMostCurves - 1)]);
  }
  return some;
}

/// The label of a curve and where it ends.
struct Label {
  double y = 0;
  std::size_t colour = 0;
  std::string name;
  std::string text;
};

void write_labels(std::vector<Label> labels, Plot& plot) {
  std::ranges::stable_sort(labels, {}, &Label::y);
  constexpr double kApart = 32;
  double free = 14;
  for (Label& label : labels) {
    label.y = std::max(label.y, free);
    free = label.y + kApart;
  }
  // The lowest ones move up where there is no room below.
  double lowest = 284;
  for (std::size_t i = labels.size(); i-- > 0;) {
    labels[i].y = std::min(labels[i].y, lowest);
    lowest = labels[i].y - kApart;
  }
  for (const Label& label : labels) {
    plot.text(kCurvesRight + 12, label.y, "start", "label strong " + colour_class(label.colour),
              label.name);
    plot.text(kCurvesRight + 12, label.y + 13, "start", "tick", label.text);
  }
}

}  // namespace

std::string survival_plot(const Analysis& analysis, const MetricAnalysis& metric) {
  const auto& file = analysis.plan.experiment.metrics[metric.metric];
  if (!file.time_to_event) return "";
  double latest = 0;
  for (const MetricSummary& summary : metric.summaries) {
    for (const auto& time : summary.times) latest = std::max(latest, time.time);
  }
  const Axis x(0, latest, kCurvesLeft, kCurvesRight);
  const Axis y(0, 1, kCurvesBottom, 12);
  Plot plot(kCurvesWidth, 300, "Share of runs without the event of " + *file.name);
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    plot.line(kCurvesLeft, y.at(share), kCurvesRight, y.at(share), "grid");
    plot.text(kCurvesLeft - 6, y.at(share) + 4, "end", "tick",
              fmt::format("{:.0f} %", share * 100));
  }
  for (const double tick : x.ticks()) {
    plot.text(x.at(tick), kCurvesBottom + 16, "middle", "tick", number_text(tick));
  }
  std::vector<Label> labels;
  for (const std::size_t c : chosen(metric.ranking)) {
    const auto steps = statistics::kaplan_meier(metric.summaries[c].times);
    if (steps.empty()) continue;
    std::string path = fmt::format("M{:.1f} {:.1f}", x.at(0), y.at(1));
    const std::string colour = colour_class(labels.size());
    for (const auto& step : steps) {
      path += fmt::format(" H{:.1f} V{:.1f}", x.at(step.time), y.at(step.share));
      if (step.censored > 0) {
        plot.line(x.at(step.time), y.at(step.share) - 5, x.at(step.time), y.at(step.share) + 5,
                  "censored " + colour);
      }
    }
    plot.path(path, fmt::format("curve {} d{}", colour, labels.size() % 3));
    const auto half = statistics::median_time(steps);
    labels.push_back({y.at(steps.back().share), labels.size(), analysis.plan.text_of(c),
                      half ? "half by " + number_text(*half) + " " + file.unit : "never half"});
  }
  write_labels(std::move(labels), plot);
  plot.text((kCurvesLeft + kCurvesRight) / 2, kCurvesBottom + 38, "middle", "axis",
            metric_title(file) + " (a tick: a run that ended before)");
  return std::move(plot).svg();
}

}  // namespace rave::experiment
