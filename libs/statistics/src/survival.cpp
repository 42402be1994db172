// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/survival.hpp"

#include <algorithm>
#include <cmath>

namespace rave::statistics {

std::vector<SurvivalStep> kaplan_meier(std::span<const TimedEvent> times) {
  std::vector<TimedEvent> sorted(times.begin(), times.end());
  std::ranges::sort(sorted, {}, &TimedEvent::time);
  std::vector<SurvivalStep> curve;
  double share = 1;
  for (std::size_t begin = 0; begin < sorted.size();) {
    SurvivalStep step;
    step.time = sorted[begin].time;
    step.at_risk = sorted.size() - begin;
    while (begin < sorted.size() && sorted[begin].time == step.time) {
      ++(sorted[begin++].seen ? step.events : step.censored);
    }
    share *= 1 - static_cast<double>(step.events) / static_cast<double>(step.at_risk);
    step.share = share;
    curve.push_back(step);
  }
  return curve;
}

std::optional<double> median_time(std::span<const SurvivalStep> curve) {
  for (const SurvivalStep& step : curve) {
    if (step.share <= 0.5 + 1e-12) return step.time;
  }
  return std::nullopt;
}

TestResult log_rank(std::span<const TimedEvent> a, std::span<const TimedEvent> b) {
  std::vector<TimedEvent> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  const auto at_risk = [](std::span<const TimedEvent> times, double time) {
    return static_cast<double>(
        std::ranges::count_if(times, [time](const auto& t) { return t.time >= time; }));
  };
  double difference = 0;
  double variance = 0;
  for (const SurvivalStep& step : kaplan_meier(all)) {
    if (step.events == 0) continue;
    const auto events = static_cast<double>(step.events);
    const auto n = static_cast<double>(step.at_risk);
    const double risk = at_risk(a, step.time);
    const auto own = static_cast<double>(
        std::ranges::count_if(a, [&step](const auto& t) { return t.seen && t.time == step.time; }));
    difference += own - events * risk / n;
    if (n > 1) variance += events * (risk / n) * (1 - risk / n) * (n - events) / (n - 1);
  }
  if (variance <= 0) return {0, 1, false};
  const double squared = difference * difference / variance;
  return {difference < 0 ? -squared : squared, std::erfc(std::sqrt(squared / 2)), false};
}

}  // namespace rave::statistics
