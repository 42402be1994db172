// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "processing_support.hpp"
#include "rave/math/scalar.hpp"

namespace rave {
namespace {

constexpr int kCount = 100'000;

/// Mean and standard deviation of errors, compared with five of their standard errors.
class Moments {
 public:
  void add(double error) {
    sum_ += error;
    squares_ += error * error;
    ++count_;
  }
  void expect(double sigma) const {
    const double n = count_;
    EXPECT_NEAR(sum_ / n, 0, 5 * sigma / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(squares_ / n), sigma, 5 * sigma / std::sqrt(2 * n));
  }

 private:
  double sum_ = 0;
  double squares_ = 0;
  int count_ = 0;
};

/// The records of `kind` after noise, sample after sample, each from the same `raw`.
template <class Record, class Look>
void each_sample(const NoiseSpec& noise, ReadingKind kind, const Record& raw, Look look) {
  const Processing chain = made({.noise = noise}, kind, 1);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    SampleHeader header = header_of(0, 1);
    Record record = raw;
    chain.apply_noise(header, &record, stream(i));
    look(header, record);
  }
}

void expect_rate(int hits, double probability) {
  EXPECT_NEAR(1.0 * hits / kCount, probability,
              5 * std::sqrt(probability * (1 - probability) / kCount));
}

TEST(Noise, RangesScatterWithTheLengthSigma) {
  Moments moments;
  each_sample<float>({.length_sigma_m = 0.03}, ReadingKind::kRanges, 5.0F,
                     [&](const SampleHeader&, float range) { moments.add(range - 5.0); });
  moments.expect(0.03);
}

TEST(Noise, RaysOfOneSampleAreIndependent) {
  const Processing chain = made({.noise = {.length_sigma_m = 1}}, ReadingKind::kRanges, 2);
  double product = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    SampleHeader header = header_of(0, 2);
    float rays[2] = {50, 50};
    chain.apply_noise(header, rays, stream(i));
    product += (rays[0] - 50.0) * (rays[1] - 50.0) / kCount;
  }
  EXPECT_NEAR(product, 0, 5 / std::sqrt(kCount));
}

TEST(Noise, RangesNeverTurnNegativeAndNoReturnStays) {
  int zeros = 0;
  each_sample<float>({.length_sigma_m = 0.1}, ReadingKind::kRanges, 0.0F,
                     [&](const SampleHeader&, float range) {
                       EXPECT_GE(range, 0);
                       if (range == 0) ++zeros;
                     });
  expect_rate(zeros, 0.5);
  each_sample<float>({.length_sigma_m = 0.1, .length_quantum_m = 0.1}, ReadingKind::kRanges,
                     kNoReturn,
                     [&](const SampleHeader&, float range) { ASSERT_EQ(range, kNoReturn); });
}

TEST(Noise, PutsNoRangeBeyondWhatTheSensorMeasures) {
  for (const NoiseSpec& noise :
       {NoiseSpec{.length_sigma_m = 0.1}, NoiseSpec{.length_quantum_m = 0.3},
        NoiseSpec{.length_sigma_m = 0.1, .length_quantum_m = 0.01}}) {
    const auto chain =
        Processing::make({noise, 0, {}}, ReadingKind::kRanges, 19, 0.1, {0.25, 4}).value();
    int beyond = 0;
    int nearest = 0;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      float rays[19];
      // In odd places at the largest range, in even ones at the least.
      for (std::size_t k = 0; k < 19; ++k) rays[k] = k % 2 == 1 ? 4.0F : 0.25F;
      rays[0] = kNoReturn;
      rays[2] = -kNoReturn;
      SampleHeader header = header_of(0, 19);
      chain.apply_noise(header, rays, stream(i));
      EXPECT_EQ(rays[0], kNoReturn);
      EXPECT_EQ(rays[2], -kNoReturn);
      for (std::size_t k = 3; k < 19; ++k) {
        if (rays[k] == kNoReturn) {
          ++beyond;
          EXPECT_EQ(k % 2, 1U);
          continue;
        }
        ASSERT_LE(rays[k], 4.0F) << "a finite range that no such sensor gives";
        ASSERT_GE(rays[k], 0.25F);
        if (rays[k] == 0.25F) ++nearest;
      }
    }
    if (noise.length_sigma_m > 0) {
      EXPECT_NEAR(beyond, 4000, 300) << "half of those at the largest range";
      EXPECT_GT(nearest, 3000);
    }
  }
}

TEST(Noise, QuantisationGivesExactMultiplesAndAUniformError) {
  constexpr double kQuantum_m = 0.25;
  Moments moments;
  each_sample<PoseReading>({.length_sigma_m = 3, .length_quantum_m = kQuantum_m},
                           ReadingKind::kPose, {}, [&](const SampleHeader&, const PoseReading& p) {
                             const double steps = p.x_m / kQuantum_m;
                             ASSERT_EQ(steps, std::floor(steps));
                             moments.add(p.x_m);
                           });
  // Sheppard's correction: rounding adds the variance of a uniform number.
  moments.expect(std::sqrt(9 + kQuantum_m * kQuantum_m / 12));

  const Processing chain = made({.noise = {.length_quantum_m = 0.1}}, ReadingKind::kRanges, 4);
  SampleHeader header = header_of(0, 4);
  float rays[4] = {0.349F, 0.351F, 0.04F, kNoReturn};
  chain.apply_noise(header, rays, stream(0));
  EXPECT_EQ(rays[0], static_cast<float>(3 * 0.1));
  EXPECT_EQ(rays[1], static_cast<float>(4 * 0.1));
  EXPECT_EQ(rays[2], 0);
  EXPECT_EQ(rays[3], kNoReturn);
}

TEST(Noise, LostRaysReadNoReturn) {
  int lost = 0;
  each_sample<float>({.dropout_probability = 0.2}, ReadingKind::kRanges, 1.0F,
                     [&](const SampleHeader& header, float range) {
                       ASSERT_EQ(header.count, 1U);
                       ASSERT_TRUE(range == 1.0F || range == kNoReturn);
                       if (range == kNoReturn) ++lost;
                     });
  expect_rate(lost, 0.2);
}

TEST(Noise, SightingsAreDisturbedAndThinnedOutInOrder) {
  const Processing chain =
      made({.noise = {.length_sigma_m = 0.05, .angle_sigma_rad = 0.02, .dropout_probability = 0.3}},
           ReadingKind::kSightings, 4);
  Moments range;
  Moments bearing;
  int lost = 0;
  for (std::uint32_t i = 0; i < kCount / 4; ++i) {
    SampleHeader header = header_of(0, 4);
    Sighting seen[4];
    for (int k = 0; k < 4; ++k) seen[k] = {k * 10, k, 4, 0.5F, 0};
    chain.apply_noise(header, seen, stream(i));
    lost += static_cast<int>(4 - header.count);
    for (std::uint32_t k = 0; k < header.count; ++k) {
      ASSERT_EQ(seen[k].stamp_ns, seen[k].code * 10);
      if (k > 0) {
        ASSERT_LT(seen[k - 1].code, seen[k].code);
      }
      range.add(seen[k].range_m - 4.0);
      bearing.add(seen[k].bearing_rad - 0.5);
    }
  }
  expect_rate(lost, 0.3);
  range.expect(0.05);
  bearing.expect(0.02);
}

TEST(Noise, PosesScatterAndSayThatTheyAreLessCertain) {
  Moments x;
  Moments y;
  Moments yaw;
  const PoseReading raw{1, -2, kPi, 0.01, 0.02};
  each_sample<PoseReading>({.length_sigma_m = 0.1, .angle_sigma_rad = 0.2}, ReadingKind::kPose, raw,
                           [&](const SampleHeader&, const PoseReading& pose) {
                             x.add(pose.x_m - 1);
                             y.add(pose.y_m + 2);
                             ASSERT_LE(std::abs(pose.yaw_rad), kPi);
                             yaw.add(wrap_angle(pose.yaw_rad - kPi));
                             ASSERT_DOUBLE_EQ(pose.variance_xy_m2, 0.01 + 0.1 * 0.1);
                             ASSERT_DOUBLE_EQ(pose.variance_yaw_rad2, 0.02 + 0.2 * 0.2);
                           });
  x.expect(0.1);
  y.expect(0.1);
  yaw.expect(0.2);
}

TEST(Noise, OdometryLeavesTheTurningRateAlone) {
  Moments v;
  Moments x;
  const OdometryReading raw{1, 2, 0.3, 0.5, 0.7, 0, 0};
  each_sample<OdometryReading>(
      {.length_sigma_m = 0.1, .angle_sigma_rad = 0.2, .velocity_sigma_mps = 0.3},
      ReadingKind::kOdometry, raw, [&](const SampleHeader&, const OdometryReading& odometry) {
        x.add(odometry.x_m - 1);
        v.add(odometry.v_mps - 0.5);
        ASSERT_EQ(odometry.w_radps, 0.7);
      });
  x.expect(0.1);
  v.expect(0.3);
}

TEST(Noise, NeighboursScatterInAllFields) {
  Moments range;
  Moments bearing;
  Moments vx;
  Moments vy;
  const NeighbourReading raw{9, 3, 0.1F, 0.5F, -0.5F, 0};
  each_sample<NeighbourReading>(
      {.length_sigma_m = 0.1, .angle_sigma_rad = 0.2, .velocity_sigma_mps = 0.3},
      ReadingKind::kNeighbours, raw, [&](const SampleHeader&, const NeighbourReading& other) {
        ASSERT_EQ(other.robot, 9U);
        range.add(other.range_m - 3.0);
        bearing.add(other.bearing_rad - double{0.1F});
        vx.add(other.vx_mps - 0.5);
        vy.add(other.vy_mps + 0.5);
      });
  range.expect(0.1);
  bearing.expect(0.2);
  vx.expect(0.3);
  vy.expect(0.3);
}

TEST(Noise, VelocityScattersInSpeedAlone) {
  Moments v;
  each_sample<VelocityReading>({.velocity_sigma_mps = 0.3}, ReadingKind::kVelocity, {1, 2},
                               [&](const SampleHeader&, const VelocityReading& velocity) {
                                 v.add(velocity.v_mps - 1);
                                 ASSERT_EQ(velocity.w_radps, 2);
                               });
  v.expect(0.3);
}

TEST(Noise, WholeSamplesOfOtherKindsDropOut) {
  int lost = 0;
  const auto count = [&](const SampleHeader& header, const auto&) { lost += header.count == 0; };
  const NoiseSpec noise{.dropout_probability = 0.1};
  each_sample<PoseReading>(noise, ReadingKind::kPose, {}, count);
  expect_rate(lost, 0.1);
  lost = 0;
  each_sample<OdometryReading>(noise, ReadingKind::kOdometry, {}, count);
  expect_rate(lost, 0.1);
  lost = 0;
  each_sample<VelocityReading>(noise, ReadingKind::kVelocity, {}, count);
  expect_rate(lost, 0.1);
  lost = 0;
  each_sample<ContactReading>(noise, ReadingKind::kContact, {1, 0.5F}, count);
  expect_rate(lost, 0.1);
  lost = 0;
  each_sample<double>(noise, ReadingKind::kValues, 12.5, count);
  expect_rate(lost, 0.1);
}

TEST(Noise, OneTermDoesNotChangeTheNumbersOfAnother) {
  const auto run = [](const NoiseSpec& noise) {
    const Processing chain = made({.noise = noise}, ReadingKind::kNeighbours, 3);
    SampleHeader header = header_of(0, 3);
    std::vector<NeighbourReading> others(3, {0, 5, 0, 0, 0, 0});
    for (std::uint32_t k = 0; k < 3; ++k) others[k].robot = k;
    chain.apply_noise(header, others.data(), stream(1));
    others.resize(header.count);
    return others;
  };
  const auto all = run({.length_sigma_m = 0.1, .angle_sigma_rad = 0.2, .velocity_sigma_mps = 0.3});
  const auto speed = run({.velocity_sigma_mps = 0.3});
  const auto thin = run({.length_sigma_m = 0.1,
                         .angle_sigma_rad = 0.2,
                         .velocity_sigma_mps = 0.3,
                         .dropout_probability = 0.5});
  ASSERT_EQ(all.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(all[k].vx_mps, speed[k].vx_mps);
    EXPECT_EQ(all[k].vy_mps, speed[k].vy_mps);
    EXPECT_NE(all[k].range_m, 5);
    EXPECT_EQ(speed[k].range_m, 5);
  }
  ASSERT_GT(thin.size(), 0U);
  ASSERT_LT(thin.size(), 3U);
  for (const NeighbourReading& left : thin) {
    // Bit for bit is the point. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    EXPECT_EQ(std::memcmp(&left, &all[left.robot], sizeof left), 0);
  }
  // The same drop-outs without any other noise.
  const auto only = run({.dropout_probability = 0.5});
  ASSERT_EQ(only.size(), thin.size());
  for (std::size_t k = 0; k < only.size(); ++k) EXPECT_EQ(only[k].robot, thin[k].robot);
}

TEST(Noise, ReachesTheNewestOfTheRing) {
  const Processing chain =
      made({.noise = {.length_sigma_m = 0.1, .dropout_probability = 0.2}}, ReadingKind::kRanges, 8);
  std::vector<std::byte> state = fresh_state(chain);
  for (std::uint32_t i = 0; i < 100; ++i) {
    float direct[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    float ringed[8];
    chain.push(header_of(i, 8), direct, stream(i), state.data());
    SampleHeader header;
    ASSERT_TRUE(chain.deliver({i}, state.data(), &header, ringed));
    SampleHeader own = header_of(i, 8);
    chain.apply_noise(own, direct, stream(i));
    // Bit for bit is the point. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
    ASSERT_EQ(std::memcmp(direct, ringed, sizeof direct), 0);
  }
}

}  // namespace
}  // namespace rave
