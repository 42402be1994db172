// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "processing_support.hpp"
#include "rave/math/scalar.hpp"

namespace rave {
namespace {

constexpr double kPeriod_s = 0.01;
constexpr std::int64_t kPeriod_ns = 10'000'000;

FilterSpec median(int window) { return {.window = window}; }
FilterSpec exponential(double time_constant_s) {
  return {.kind = FilterSpec::Kind::kExponential, .time_constant_s = time_constant_s};
}

/// What comes out of the filters for each sample that goes in, one period apart.
template <class Record>
std::vector<Record> filtered(const std::vector<FilterSpec>& filters, ReadingKind kind,
                             const std::vector<Record>& raw) {
  const Processing chain = made({.filters = filters}, kind, 1, kPeriod_s);
  std::vector<std::byte> state = fresh_state(chain);
  std::vector<Record> out(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const auto now_ns = static_cast<std::int64_t>(i) * kPeriod_ns;
    chain.push(header_of(now_ns, 1), &raw[i], {0, 0, 0, 0}, state.data());
    SampleHeader header;
    EXPECT_TRUE(chain.deliver({now_ns}, state.data(), &header, &out[i]));
  }
  return out;
}

TEST(MedianFilter, FollowsAHandComputedSequence) {
  const std::vector<float> raw = {5, 1, 9, 2, 2, 8, 7};
  //                      {5} {5,1} {5,1,9} {1,9,2} {9,2,2} {2,2,8} {2,8,7}
  const std::vector<float> expected = {5, 1, 5, 2, 2, 2, 7};
  EXPECT_EQ(filtered({median(3)}, ReadingKind::kRanges, raw), expected);
}

TEST(MedianFilter, CountsNoReturnAsLargest) {
  const std::vector<float> raw = {kNoReturn, 1, kNoReturn, 3, 2, kNoReturn};
  const std::vector<float> expected = {kNoReturn, 1, kNoReturn, 3, 3, 3};
  EXPECT_EQ(filtered({median(3)}, ReadingKind::kRanges, raw), expected);
}

TEST(MedianFilter, KeepsReadingsThatAreNoNumbersAtTheEnd) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto out = filtered<double>({median(3)}, ReadingKind::kValues, {1, nan, 3, nan, nan, 2, 4});
  const std::vector<double> expected = {1, 1, 3, nan, nan, nan, 4};
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(out[i])) << i;
    } else {
      EXPECT_EQ(out[i], expected[i]) << i;
    }
  }
}

TEST(MedianFilter, OfOneReadingChangesNothing) {
  const std::vector<double> raw = {3, 1, 2};
  EXPECT_EQ(filtered({median(1)}, ReadingKind::kValues, raw), raw);
}

TEST(MedianFilter, TakesTheLongestWindow) {
  std::vector<double> raw;
  for (int i = 0; i < 300; ++i) raw.push_back(i);
  const auto out = filtered({median(99)}, ReadingKind::kValues, raw);
  EXPECT_EQ(out[0], 0);
  EXPECT_EQ(out[98], 49);
  EXPECT_EQ(out[299], 250);
}

TEST(MedianFilter, OfAnglesCrossesTheWrap) {
  // 3.0, then -3.1 (that is 3.183), then 3.1: the middle one is 3.1.
  std::vector<PoseReading> raw(3);
  raw[0].yaw_rad = 3.0;
  raw[1].yaw_rad = -3.1;
  raw[2].yaw_rad = 3.1;
  raw[1].x_m = 5;
  raw[1].variance_xy_m2 = 0.25;
  const auto out = filtered({median(3)}, ReadingKind::kPose, raw);
  EXPECT_NEAR(out[2].yaw_rad, 3.1, 1e-12);
  EXPECT_EQ(out[2].x_m, 0);
  EXPECT_EQ(out[1].variance_xy_m2, 0.25);
}

TEST(ExponentialFilter, FollowsTheFormula) {
  const double gain = 1 - rave::exp(-0.5);  // T is twice the period
  const auto out = filtered<double>({exponential(0.02)}, ReadingKind::kValues, {1, 2, 2, 0});
  EXPECT_EQ(out[0], 1);
  EXPECT_DOUBLE_EQ(out[1], 1 + gain);
  EXPECT_DOUBLE_EQ(out[2], out[1] + gain * (2 - out[1]));
  EXPECT_DOUBLE_EQ(out[3], out[2] - gain * out[2]);
}

TEST(ExponentialFilter, TakesTheTimeFromTheStamps) {
  const Processing chain = made({.filters = {exponential(1)}}, ReadingKind::kValues, 1, 0);
  std::vector<std::byte> state = fresh_state(chain);
  const double values[3] = {0, 1, 5};
  const std::int64_t stamps_ns[3] = {0, 1'000'000'000, 1'000'000'000};
  double out = -1;
  SampleHeader header;
  for (int i = 0; i < 3; ++i) {
    chain.push(header_of(stamps_ns[i], 1), &values[i], {0, 0, 0, 0}, state.data());
    ASSERT_TRUE(chain.deliver({stamps_ns[i]}, state.data(), &header, &out));
    // After T, 63 % of a step; at the same instant nothing more.
    EXPECT_NEAR(out, i == 0 ? 0 : 1 - std::exp(-1.0), 1e-15);
  }
}

TEST(ExponentialFilter, StartsAnewAfterNoReturn) {
  const std::vector<float> raw = {1, kNoReturn, 4, 4};
  EXPECT_EQ(filtered({exponential(10)}, ReadingKind::kRanges, raw), raw);
}

TEST(ExponentialFilter, OfAnglesTurnsTheShortWay) {
  std::vector<OdometryReading> raw(2);
  raw[0].yaw_rad = 3.1;
  raw[1].yaw_rad = -3.1;
  raw[1].v_mps = 1;
  raw[1].w_radps = 2;
  const double gain = 1 - rave::exp(-1.0);
  const auto out = filtered({exponential(kPeriod_s)}, ReadingKind::kOdometry, raw);
  const double turn_rad = 2 * kPi - 6.2;
  EXPECT_NEAR(out[1].yaw_rad, wrap_angle(3.1 + gain * turn_rad), 1e-12);
  EXPECT_DOUBLE_EQ(out[1].v_mps, gain);
  EXPECT_DOUBLE_EQ(out[1].w_radps, 2 * gain);
}

TEST(Filters, WorkOneAfterTheOther) {
  const std::vector<double> raw = {0, 8, 0, 8, 8};
  const auto middle = filtered({median(3)}, ReadingKind::kValues, raw);
  const auto expected = filtered({exponential(0.02)}, ReadingKind::kValues, middle);
  EXPECT_EQ(filtered({median(3), exponential(0.02)}, ReadingKind::kValues, raw), expected);
  EXPECT_NE(filtered({exponential(0.02), median(3)}, ReadingKind::kValues, raw), expected);
}

TEST(Filters, KeepRaysApart) {
  const Processing chain = made({.filters = {median(3)}}, ReadingKind::kRanges, 3, kPeriod_s);
  std::vector<std::byte> state = fresh_state(chain);
  SampleHeader header;
  float out[3];
  for (int i = 0; i < 3; ++i) {
    const float rays[3] = {static_cast<float>(i), static_cast<float>(10 - i), i == 1 ? 99.0F : 7};
    chain.push(header_of(i, 3), rays, {0, 0, 0, 0}, state.data());
    ASSERT_TRUE(chain.deliver({i}, state.data(), &header, out));
  }
  EXPECT_EQ(out[0], 1);
  EXPECT_EQ(out[1], 9);
  EXPECT_EQ(out[2], 7);
}

TEST(Filters, SeeEverySampleEvenIfOnlyTheNewestIsDelivered) {
  const Processing chain =
      made({.latency_s = 0.02, .filters = {median(3)}}, ReadingKind::kValues, 1, kPeriod_s);
  std::vector<std::byte> state = fresh_state(chain);
  const double values[3] = {1, 9, 2};
  for (int i = 0; i < 3; ++i) {
    chain.push(header_of(i, 1), &values[i], {0, 0, 0, 0}, state.data());
  }
  SampleHeader header;
  double out = 0;
  ASSERT_TRUE(chain.deliver({20'000'010}, state.data(), &header, &out));
  EXPECT_EQ(out, 2);
  EXPECT_EQ(header.stamp_ns, 2);
}

TEST(Filters, ArePassedByEmptySamples) {
  const Processing chain = made({.filters = {median(3)}}, ReadingKind::kPose, 1, kPeriod_s);
  std::vector<std::byte> state = fresh_state(chain);
  SampleHeader header;
  PoseReading out;
  const double xs[4] = {1, 0, 2, 3};
  for (int i = 0; i < 4; ++i) {
    const PoseReading raw{xs[i], 0, 0, 0, 0};
    chain.push(header_of(i, i == 1 ? 0 : 1), &raw, {0, 0, 0, 0}, state.data());
    ASSERT_TRUE(chain.deliver({i}, state.data(), &header, &out));
    EXPECT_EQ(header.count, i == 1 ? 0U : 1U);
  }
  EXPECT_EQ(out.x_m, 2);
}

}  // namespace
}  // namespace rave
