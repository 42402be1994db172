// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/analysis.hpp"

#include <gtest/gtest.h>

#include "rave/base/random.hpp"
#include "rave/experiment_report/answer.hpp"
#include "sample_experiment.hpp"

namespace rave::experiment {
namespace {

using config::ComparisonOutcome;

const std::string kSpeed = "{name: speed, key: a.speed, values: [1, 2, 3]}";

TEST(Analysis, FindsAPlantedDifferenceSeedBySeed) {
  const Plan plan =
      sample_plan(kSpeed, 12,
                  "{metric: way, condition: {speed: 3}, against: {speed: 1}, expect: more}, "
                  "{metric: way, condition: {speed: 2}, against: {speed: 1}, expect: more}");
  // Seeds differ by far more than conditions do, and the pairs show it all the same.
  const auto analysis = analyse(plan, sample_rows(plan, [](std::size_t c, std::uint64_t seed) {
                                  const double noise = seed % 2 == 0 ? 0.4 : -0.4;
                                  const double own =
                                      c == 2 ? 1 + 0.1 * static_cast<double>(seed) : 0;
                                  const double none = c == 1 ? noise : 0;
                                  return std::vector<std::optional<double>>{
                                      100.0 * static_cast<double>(seed) + own + none, std::nullopt};
                                }));
  ASSERT_TRUE(analysis.has_value()) << analysis.error().text();
  ASSERT_EQ(analysis->comparisons.size(), 2U);
  const ComparisonAnalysis& shown = analysis->comparisons[0];
  EXPECT_EQ(shown.test, ComparisonTest::kWilcoxon);
  EXPECT_EQ(shown.outcome, ComparisonOutcome::kMore);
  EXPECT_NEAR(shown.difference->estimate, 1.65, 1e-9);
  EXPECT_GT(shown.difference->low, 1.3);
  EXPECT_LT(shown.difference->high, 2.0);
  EXPECT_DOUBLE_EQ(shown.p, 2.0 / 4096);
  EXPECT_DOUBLE_EQ(shown.corrected, 4.0 / 4096);
  EXPECT_TRUE(shown.as_expected());
  EXPECT_EQ(analysis->comparisons[1].outcome, ComparisonOutcome::kNoDifference);
  EXPECT_FALSE(analysis->as_expected());
  EXPECT_EQ(analysis->metrics[0].ranking, (std::vector<std::size_t>{2, 0, 1}));
  EXPECT_TRUE(answer(*analysis).starts_with("way: speed=3 has 1.65 m (95 % interval "))
      << answer(*analysis);
}

// The trap: of fast preys only the early captures are left, and their mean falls.
TEST(Analysis, TimesToAnEventCountRunsWithoutOne) {
  const Plan plan = sample_plan(
      kSpeed, 10, "{metric: caught, condition: {speed: 3}, against: {speed: 1}, expect: more}");
  const auto analysis = analyse(plan, sample_rows(plan, [](std::size_t c, std::uint64_t seed) {
                                  const double at = 20 + static_cast<double>(seed);
                                  std::optional<double> caught;
                                  if (c < 2) caught = at;
                                  if (c == 2 && seed <= 2) caught = 5;
                                  return std::vector<std::optional<double>>{1, caught};
                                }));
  ASSERT_TRUE(analysis.has_value());
  const ComparisonAnalysis& comparison = analysis->comparisons[0];
  EXPECT_EQ(comparison.test, ComparisonTest::kLogRank);
  EXPECT_EQ(comparison.outcome, ComparisonOutcome::kMore);
  const MetricSummary& fast = analysis->metrics[1].summaries[2];
  EXPECT_FALSE(fast.centre.has_value()) << "half of them were never caught";
  EXPECT_EQ(fast.times.size(), 10U);
  EXPECT_EQ(centre_text(fast, true), "not by half");
  EXPECT_EQ(spread_text(fast, true), "2 of 10");
  EXPECT_EQ(analysis->metrics[1].summaries[0].centre->estimate, 25);
  EXPECT_EQ(analysis->metrics[1].ranking.back(), 2U);
  EXPECT_TRUE(
      sentence(*analysis, comparison)
          .starts_with("caught: it comes later with speed=3 (never half of them, 2 of 10 at all) "
                       "than with speed=1 (half by 25 s, 10 of 10 at all); log-rank test"))
      << sentence(*analysis, comparison);
}

TEST(Analysis, AComparisonWithoutAFactorIsOneForEachOfItsValues) {
  const Plan plan = sample_plan(kSpeed + ", {name: size, key: b, values: [7, 8]}", 2,
                                "{metric: way, condition: {speed: 3}, against: {speed: 1}}");
  const auto analysis =
      analyse(plan, sample_rows(plan, [](std::size_t c, std::uint64_t) {
                return std::vector<std::optional<double>>{static_cast<double>(c), 1};
              }));
  ASSERT_TRUE(analysis.has_value());
  ASSERT_EQ(analysis->comparisons.size(), 2U);
  EXPECT_EQ(analysis->plan.text_of(analysis->comparisons[1].condition), "speed=3, size=8");
  EXPECT_EQ(analysis->plan.text_of(analysis->comparisons[1].against), "speed=1, size=8");
}

TEST(Analysis, FailedRunsAreMissingAndNotZero) {
  const Plan plan = sample_plan(kSpeed, 4, "");
  const auto analysis = analyse(plan, sample_rows(plan, [](std::size_t c, std::uint64_t seed) {
                                  if (c == 1 && seed == 2)
                                    return std::vector<std::optional<double>>{};
                                  return std::vector<std::optional<double>>{5, 1};
                                }));
  ASSERT_TRUE(analysis.has_value());
  EXPECT_EQ(analysis->failed.size(), 1U);
  EXPECT_EQ(analysis->metrics[0].summaries[1].values.size(), 3U);
  EXPECT_EQ(analysis->metrics[0].summaries[1].centre->estimate, 5);
  EXPECT_FALSE(analyse(plan, RunRows()).has_value());
}

TEST(Analysis, APlantedNullStaysNull) {
  const Plan plan =
      sample_plan(kSpeed, 10, "{metric: way, condition: {speed: 3}, against: {speed: 1}}");
  int shown = 0;
  for (std::uint32_t set = 0; set < 200; ++set) {
    const auto analysis =
        analyse(plan, sample_rows(plan, [set](std::size_t c, std::uint64_t seed) {
                  RandomStream random(seed, set, static_cast<std::uint32_t>(c), 0);
                  return std::vector<std::optional<double>>{random.uniform(), 1};
                }));
    shown += analysis->comparisons[0].outcome == ComparisonOutcome::kNoDifference ? 0 : 1;
  }
  EXPECT_LE(shown, 19) << "5 % of 200, and three standard deviations";
}

TEST(Numbers, HaveThreeDigitsForPeople) {
  EXPECT_EQ(number_text(0.0123456), "0.0123");
  EXPECT_EQ(number_text(-4.4), "-4.4");
  EXPECT_EQ(number_text(1234.6), "1235");
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(p_text(0.0004), "< 0.001");
  EXPECT_EQ(p_text(0.034), "0.034");
}

}  // namespace
}  // namespace rave::experiment
