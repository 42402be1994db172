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
