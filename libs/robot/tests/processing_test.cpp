// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/processing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "processing_support.hpp"
#include "rave/math/scalar.hpp"

namespace rave {
namespace {

constexpr int kCount = 100'000;

RandomStream stream(std::uint32_t sample) { return {7, 3, 2, sample}; }

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

TEST(Latency, DeliversEachSampleWhenItIsDue) {
  const Processing chain = made({.latency_s = 0.1}, ReadingKind::kValues, 1, 0.01);
  EXPECT_EQ(chain.depth(), 11U);
  std::vector<std::byte> state = fresh_state(chain);
  constexpr std::int64_t kStep_ns = 10'000'000;
  for (std::int64_t step = 0; step < 1000; ++step) {
    const double value = static_cast<double>(step);
    chain.push(header_of(step * kStep_ns, 1), &value, stream(0), state.data());
    SampleHeader header;
    double out = -1;
    const bool came = chain.deliver({step * kStep_ns}, state.data(), &header, &out);
    ASSERT_EQ(came, step >= 10) << step;
    if (!came) continue;
    ASSERT_EQ(header.stamp_ns, (step - 10) * kStep_ns);
    ASSERT_EQ(out, static_cast<double>(step - 10));
    ASSERT_EQ(header.dropped, 0U);
    ASSERT_FALSE(chain.deliver({step * kStep_ns}, state.data(), &header, &out));
  }
}

TEST(Latency, IsNotServedANanosecondEarly) {
  const Processing chain = made({.latency_s = 0.005}, ReadingKind::kValues, 1, 0.01);
  EXPECT_EQ(chain.depth(), 2U);
  std::vector<std::byte> state = fresh_state(chain);
  const double value = 1;
  chain.push(header_of(1000, 1), &value, stream(0), state.data());
  SampleHeader header;
  double out = 0;
  EXPECT_FALSE(chain.deliver({5'000'999}, state.data(), &header, &out));
  EXPECT_TRUE(chain.deliver({5'001'000}, state.data(), &header, &out));
}

TEST(Latency, AFullRingLosesTheOldestAndSaysSo) {
  const Processing chain = made({.latency_s = 0.02}, ReadingKind::kRanges, 4, 0.01);
  ASSERT_EQ(chain.depth(), 3U);
  std::vector<std::byte> state = fresh_state(chain);
  for (int i = 0; i < 5; ++i) {
    const float rays[4] = {static_cast<float>(i), 0, 0, 0};
    chain.push(header_of(i, 2), rays, stream(0), state.data());
  }
  SampleHeader header;
  float out[4] = {};
  ASSERT_TRUE(chain.deliver({20'000'002}, state.data(), &header, out));
  EXPECT_EQ(out[0], 2);
  EXPECT_EQ(header.dropped, 4U);  // two samples of two records
  ASSERT_TRUE(chain.deliver({20'000'004}, state.data(), &header, out));
  EXPECT_EQ(out[0], 4);
  EXPECT_EQ(header.dropped, 0U);
}

TEST(Latency, IrregularSourcesHaveRoomForManySamples) {
  const Processing chain = made({.latency_s = 0.1}, ReadingKind::kValues, 1, 0);
  EXPECT_EQ(chain.depth(), 64U);
}

TEST(Processing, RecordsBeyondTheCapacityAreCounted) {
  const Processing chain = made({}, ReadingKind::kValues, 2);
  std::vector<std::byte> state = fresh_state(chain);
  const double values[5] = {1, 2, 3, 4, 5};
  SampleHeader raw = header_of(0, 5);
  raw.dropped = 7;
  raw.sequence = 12;
  chain.push(raw, values, stream(0), state.data());
  SampleHeader header;
  double out[2] = {};
  ASSERT_TRUE(chain.deliver({0}, state.data(), &header, out));
  EXPECT_EQ(header.count, 2U);
  EXPECT_EQ(header.dropped, 10U);
  EXPECT_EQ(header.sequence, 12U);
  EXPECT_EQ(out[1], 2);
}

TEST(Processing, ResetForgetsEverything) {
  const ProcessingSpec spec{
      .noise = {.length_sigma_m = 0.1, .dropout_probability = 0.1},
      .latency_s = 0.03,
      .filters = {{.window = 3},
                  {.kind = FilterSpec::Kind::kExponential, .time_constant_s = 0.05}}};
  const Processing chain = made(spec, ReadingKind::kRanges, 5, 0.01);
  ASSERT_EQ(chain.state_size() % 8, 0U);
  const auto run = [&](std::byte* state) {
    std::vector<float> delivered;
    for (std::uint32_t i = 0; i < 50; ++i) {
      const float raw[5] = {1.0F * static_cast<float>(i), 2, 3, 4, 5};
      chain.push(header_of(std::int64_t{i} * 10'000'000, 5), raw, stream(i), state);
      SampleHeader header;
      float out[5];
      if (chain.deliver({std::int64_t{i} * 10'000'000}, state, &header, out)) {
        delivered.insert(delivered.end(), out, out + 5);
      }
    }
    return delivered;
  };
  std::vector<std::byte> state(chain.state_size() + 8, std::byte{0xAB});
  chain.reset(state.data());
  for (std::size_t i = chain.state_size(); i < state.size(); ++i) {
    ASSERT_EQ(state[i], std::byte{0xAB}) << "wrote beyond the state";
  }
  const auto first = run(state.data());
  const std::vector<std::byte> after = state;
  chain.reset(state.data());
  const auto second = run(state.data());
  ASSERT_EQ(first.size(), 47U * 5);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(float)), 0);
  EXPECT_EQ(after, state);
}

TEST(Processing, MovesWithItsMeaning) {
  Processing first = made({.latency_s = 0.1, .filters = {{.window = 3}}}, ReadingKind::kPose, 1);
  const std::size_t size = first.state_size();
  const Processing second = std::move(first);
  EXPECT_EQ(second.state_size(), size);
}

TEST(Processing, KnowsWhenThereIsNothingToDo) {
  EXPECT_TRUE(ProcessingSpec{}.empty());
  EXPECT_FALSE((ProcessingSpec{.latency_s = 0.1}.empty()));
  EXPECT_FALSE((ProcessingSpec{.filters = {{}}}.empty()));
  for (double NoiseSpec::*term :
       {&NoiseSpec::length_sigma_m, &NoiseSpec::angle_sigma_rad, &NoiseSpec::velocity_sigma_mps,
        &NoiseSpec::length_quantum_m, &NoiseSpec::angle_quantum_rad,
        &NoiseSpec::velocity_quantum_mps, &NoiseSpec::dropout_probability}) {
    ProcessingSpec spec;
    spec.noise.*term = 0.5;
    EXPECT_FALSE(spec.empty());
  }
}

std::string refusal(const ProcessingSpec& spec, ReadingKind kind = ReadingKind::kRanges,
                    std::uint32_t capacity = 1, double period_s = 0.01) {
  const auto chain = Processing::make(spec, kind, capacity, period_s);
  return chain ? "accepted" : chain.error().text();
}

TEST(ProcessingErrors, SayWhatIsWrong) {
  EXPECT_EQ(refusal({.noise = {.length_sigma_m = -1}}),
            "noise: `length_sigma_m` is -1; it must be a finite number of at least 0");
  EXPECT_EQ(refusal({.noise = {.length_quantum_m = std::nan("")}}),
            "noise: `length_quantum_m` is nan; it must be a finite number of at least 0");
  EXPECT_EQ(refusal({.noise = {.angle_sigma_rad = 0.1}}),
            "noise: `angle_sigma_rad` has no effect on a sensor of kind `ranges`");
  EXPECT_EQ(refusal({.noise = {.velocity_sigma_mps = 0.1}}, ReadingKind::kPose),
            "noise: `velocity_sigma_mps` has no effect on a sensor of kind `pose`");
  EXPECT_EQ(refusal({.noise = {.length_sigma_m = 0.1}}, ReadingKind::kContact),
            "noise: `length_sigma_m` has no effect on a sensor of kind `contact`");
  EXPECT_EQ(refusal({.noise = {.dropout_probability = 1.5}}),
            "noise: `dropout_probability` is 1.5; it must lie between 0 and 1");
  EXPECT_EQ(refusal({.latency_s = -0.1}),
            "`latency_s` is -0.1; it must lie between 0 and 3600 seconds");
  EXPECT_EQ(refusal({}, ReadingKind::kRanges, 1, -1),
            "the period is -1 s; it must be 0 for an irregular source or lie between 1e-9 and 1e9 "
            "seconds");
  EXPECT_EQ(refusal({}, ReadingKind::kRanges, 0),
            "a sensor of kind `ranges` with 0 records has nothing to process");
  EXPECT_EQ(refusal({}, ReadingKind::kNone),
            "a sensor of kind `nothing` with 1 records has nothing to process");
  EXPECT_EQ(refusal({.latency_s = 3600, .filters = {{}}}, ReadingKind::kRanges, 180, 0.001),
            "the processing chain would need more than 64 MiB per robot: 3600001 delayed samples "
            "of 180 records each and 1 filters; shorten the latency, lengthen the period or use "
            "smaller filters");
}

TEST(ProcessingErrors, FiltersSayWhatTheyCanDo) {
  for (const ReadingKind kind :
       {ReadingKind::kSightings, ReadingKind::kNeighbours, ReadingKind::kContact}) {
    EXPECT_EQ(refusal({.filters = {{}}}, kind),
              fmt::format("filter: a sensor of kind `{}` cannot be filtered, because its number of "
                          "records varies; filters work on ranges, pose, odometry, velocity and "
                          "values",
                          to_string(kind)));
  }
  for (const int window : {4, 0, -3, 101}) {
    EXPECT_EQ(refusal({.filters = {{.window = window}}}),
              fmt::format("median filter: `window` is {}; it must be an odd number from 1 to 99",
                          window));
  }
  EXPECT_EQ(refusal({.filters = {{.kind = FilterSpec::Kind::kExponential}}}),
            "exponential filter: `time_constant_s` is 0; it must be a finite number above 0");
}

}  // namespace
}  // namespace rave
