// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/survival.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rave::statistics {
namespace {

std::vector<TimedEvent> seen(std::initializer_list<double> times) {
  std::vector<TimedEvent> events;
  for (const double time : times) events.push_back({time, true});
  return events;
}

/// Weeks of remission of leukaemia: Freireich and others, Blood 21, 1963, the standard example of
/// textbooks. With 6-mercaptopurine, and without.
std::vector<TimedEvent> treated() {
  std::vector<TimedEvent> events = seen({6, 6, 6, 7, 10, 13, 16, 22, 23});
  for (const double time : {6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35}) {
    events.push_back({time, false});
  }
  return events;
}
std::vector<TimedEvent> untreated() {
  return seen({1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23});
}

TEST(KaplanMeier, OfAPublishedExample) {
  const auto curve = kaplan_meier(treated());
  const std::vector<std::pair<double, double>> published = {
      {6, 0.857}, {7, 0.807}, {10, 0.753}, {13, 0.690}, {16, 0.627}, {22, 0.538}, {23, 0.448}};
  std::size_t found = 0;
  for (const SurvivalStep& step : curve) {
    if (step.events == 0) continue;
    ASSERT_LT(found, published.size());
    EXPECT_EQ(step.time, published[found].first);
    EXPECT_NEAR(step.share, published[found].second, 5e-4);
    ++found;
  }
  EXPECT_EQ(found, published.size());
  EXPECT_EQ(median_time(curve), 23);
  EXPECT_EQ(median_time(kaplan_meier(untreated())), 8);
  EXPECT_EQ(curve[0].at_risk, 21U);
  EXPECT_EQ(curve[0].censored, 1U);
}

TEST(KaplanMeier, WithoutCensoringIsTheShareThatIsLeft) {
  const auto curve = kaplan_meier(seen({3, 1, 2, 2}));
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_DOUBLE_EQ(curve[1].share, 0.25);
  EXPECT_FALSE(median_time(kaplan_meier(std::vector<TimedEvent>{{5, false}})).has_value());
}

TEST(LogRank, OfAPublishedExample) {
  const TestResult result = log_rank(treated(), untreated());
  EXPECT_NEAR(result.statistic, -16.793, 5e-4);
  EXPECT_NEAR(result.p, 4.17e-5, 1e-7);
  EXPECT_NEAR(log_rank(untreated(), treated()).statistic, 16.793, 5e-4);
}

// Two and one: all by hand. At time 1 one of three, expected 2/3; at 2 one of two, expected 1/2.
TEST(LogRank, BySumsOnPaper) {
  const TestResult result = log_rank(seen({1, 3}), seen({2}));
  const double difference = 2 - (2.0 / 3 + 0.5 + 1);
  const double variance = 2.0 / 9 + 0.25;
  EXPECT_NEAR(result.statistic, -difference * difference / variance, 1e-12);
  EXPECT_NEAR(result.p, std::erfc(std::sqrt(difference * difference / variance / 2)), 1e-12);
}

TEST(LogRank, WithoutEventsShowsNothing) {
  EXPECT_EQ(log_rank(std::vector<TimedEvent>{{5, false}}, std::vector<TimedEvent>{{5, false}}).p,
            1);
  EXPECT_EQ(log_rank({}, seen({1})).p, 1);
}

}  // namespace
}  // namespace rave::statistics
