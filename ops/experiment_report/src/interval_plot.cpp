// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "plot.hpp"
#include "plots.hpp"
#include "rave/base/number.hpp"
#include "rave/experiment_report/answer.hpp"

namespace rave::experiment {
namespace {

constexpr double kWidth = 640;
constexpr double kLabels = 190;
constexpr double kRow = 28;
constexpr std::size_t kMostRows = 40;
constexpr std::size_t kMostDots = 200;

/// Rows with a dot, an interval and small dots.
struct Row {
  std::string label;
  statistics::Interval interval;
  const std::vector<double>* values = nullptr;
};

std::string rows_plot(const std::vector<Row>& rows, const std::string& axis_title, bool zero,
                      std::string_view title) {
  double low = zero ? 0 : 1e300;
  double high = zero ? 0 : -1e300;
  for (const Row& row : rows) {
    low = std::min({low, row.interval.low, std::ranges::min(*row.values)});
    high = std::max({high, row.interval.high, std::ranges::max(*row.values)});
  }
  const double bottom = 12 + kRow * static_cast<double>(rows.size());
  const Axis axis(low, high, kLabels, kWidth - 16);
  Plot plot(kWidth, bottom + 44, title);
  for (const double tick : axis.ticks()) {
    plot.line(axis.at(tick), 8, axis.at(tick), bottom, "grid");
    plot.text(axis.at(tick), bottom + 16, "middle", "tick", number_text(tick));
  }
  if (zero) plot.line(axis.at(0), 8, axis.at(0), bottom, "zero");
  double y = 12 + kRow / 2;
  for (const Row& row : rows) {
    plot.text(kLabels - 10, y + 4, "end", "label", row.label);
    const std::size_t every = row.values->size() / kMostDots + 1;
    for (std::size_t i = 0; i < row.values->size(); i += every) {
      plot.dot(axis.at((*row.values)[i]), y + 8, 1.5, "run c0");
    }
    plot.line(axis.at(row.interval.low), y, axis.at(row.interval.high), y, "bar c0");
    plot.dot(axis.at(row.interval.estimate), y, 4.5, "mean c0",
             row.label + ": " + number_text(row.interval.estimate));
    y += kRow;
  }
  plot.text((kLabels + kWidth) / 2, bottom + 36, "middle", "axis", axis_title);
  return std::move(plot).svg();
}

}  // namespace

std::string interval_plot(const Analysis& analysis, const MetricAnalysis& metric) {
  const auto& file = analysis.plan.experiment.metrics[metric.metric];
  std::vector<Row> rows;
  for (const std::size_t c : metric.ranking) {
    const MetricSummary& summary = metric.summaries[c];
    if (!summary.centre || summary.values.empty() || rows.size() == kMostRows) continue;
    rows.push_back({analysis.plan.text_of(c), *summary.centre, &summary.values});
  }
  if (rows.empty()) return "";
  return rows_plot(rows, metric_title(file), false, "Means with intervals of " + *file.name);
}

std::string difference_plot(const Analysis& analysis, std::size_t metric) {
  const auto& file = analysis.plan.experiment.metrics[metric];
  std::vector<Row> rows;
  for (const ComparisonAnalysis& comparison : analysis.comparisons) {
    if (comparison.metric != metric || comparison.differences.empty() || rows.size() == kMostRows) {
      continue;
    }
    rows.push_back({analysis.plan.text_of(comparison.condition), *comparison.difference,
                    &comparison.differences});
  }
  if (rows.empty()) return "";
  return rows_plot(rows, "difference in " + metric_title(file), true,
                   "Differences of " + *file.name + ", seed by seed");
}

std::string curve(const Analysis& analysis, const MetricAnalysis& metric) {
  const auto& experiment = analysis.plan.experiment;
  const auto& file = experiment.metrics[metric.metric];
  if (experiment.factors.size() != 1 || file.time_to_event) return "";
  struct Point {
    double x;
    statistics::Interval y;
  };
  std::vector<Point> points;
  for (const MetricSummary& summary : metric.summaries) {
    const auto x =
        number_of<double>(analysis.plan.conditions[summary.condition].condition.levels[0]);
    if (!x) return "";
    if (summary.centre) points.push_back({*x, *summary.centre});
  }
  if (points.size() < 3) return "";
  std::ranges::sort(points, {}, &Point::x);
  double low = points[0].y.low;
  double high = points[0].y.high;
  for (const Point& point : points) {
    low = std::min(low, point.y.low);
    high = std::max(high, point.y.high);
  }
  const Axis x(points.front().x, points.back().x, 60, kWidth - 20, 8);
  const Axis y(low, high, 250, 12);
  Plot plot(kWidth, 300, *file.name + " over " + *experiment.factors[0].name);
  for (const double tick : y.ticks()) {
    plot.line(60, y.at(tick), kWidth - 20, y.at(tick), "grid");
    plot.text(54, y.at(tick) + 4, "end", "tick", number_text(tick));
  }
  for (const double tick : x.ticks()) {
    plot.text(x.at(tick), 268, "middle", "tick", number_text(tick));
  }
  std::string upper;
  std::string lower;
  std::string middle;
  for (const Point& point : points) {
    const char* const command = upper.empty() ? "M" : "L";
    upper += fmt::format("{}{:.1f} {:.1f} ", command, x.at(point.x), y.at(point.y.high));
    middle += fmt::format("{}{:.1f} {:.1f} ", command, x.at(point.x), y.at(point.y.estimate));
    lower = fmt::format("L{:.1f} {:.1f} ", x.at(point.x), y.at(point.y.low)) + lower;
  }
  plot.path(upper + lower + "Z", "band c0");
  plot.path(middle, "curve c0");
  for (const Point& point : points) {
    plot.dot(x.at(point.x), y.at(point.y.estimate), 3.5, "mean c0",
             number_text(point.x) + ": " + number_text(point.y.estimate));
  }
  const auto& factor = experiment.factors[0];
  plot.text((60 + kWidth) / 2, 290, "middle", "axis",
            *factor.name + (factor.unit.empty() ? "" : ", " + factor.unit));
  plot.upright(14, 130, metric_title(file));
  return std::move(plot).svg();
}

}  // namespace rave::experiment
