// SPDX-License-Identifier: Apache-2.0
// The filters of many rays against filters of one number each, written the plain way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "processing_support.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/each_target.hpp"

namespace rave {
namespace {

constexpr std::int64_t kTick_ns = 10'000'000;

class PlainMedian {
 public:
  explicit PlainMedian(std::size_t window) : window_(window) {}
  float operator()(float x, std::int64_t /*stamp_ns*/) {
    last_.push_back(x);
    if (last_.size() > window_) last_.pop_front();
    std::vector<float> sorted(last_.begin(), last_.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](float a, float b) { return !std::isnan(a) && (std::isnan(b) || a < b); });
    return sorted[(sorted.size() - 1) / 2];
  }

 private:
  std::size_t window_;
  std::deque<float> last_;
};

class PlainExponential {
 public:
  explicit PlainExponential(double time_constant_s) : time_constant_s_(time_constant_s) {}
  float operator()(float x, std::int64_t stamp_ns) {
    if (!std::isfinite(x)) {
      known_ = false;
      return x;
    }
    const double dt_s = static_cast<double>(stamp_ns - stamp_ns_) * 1e-9;
    output_ = known_ ? output_ + (1.0 - exp(-dt_s / time_constant_s_)) * (x - output_) : x;
    stamp_ns_ = stamp_ns;
    known_ = true;
    return static_cast<float>(output_);
  }

 private:
  double time_constant_s_;
  double output_ = 0;
  std::int64_t stamp_ns_ = 0;
  bool known_ = false;
};

/// Few different values, so that many are equal; some below zero, infinite or no number at all.
float reading(RandomStream& random) {
  const double kind = random.uniform();
  if (kind < 0.1) return kNoReturn;
  if (kind < 0.13) return -kNoReturn;
  if (kind < 0.16) return std::numeric_limits<float>::quiet_NaN();
  if (kind < 0.5) return 0.25F * std::floor(static_cast<float>(random.uniform(-4, 12)));
  return static_cast<float>(random.uniform(-1, 8));
}

/// Samples of `most` rays, of which now and then some are missing at the end.
template <class Plain>
void expect_as(const FilterSpec& filter, std::uint32_t most, int samples, const Plain& plain) {
  const Processing chain = made({.filters = {filter}}, ReadingKind::kRanges, most);
  std::vector<std::byte> state(chain.state_size() + 8, std::byte{0xAB});
  chain.reset(state.data());
  std::vector<Plain> rays(most, plain);
  RandomStream random(most, 1, 2, 3);
  std::int64_t now_ns = 0;
  for (int s = 0; s < samples; ++s) {
    now_ns += kTick_ns * (1 + static_cast<std::int64_t>(random.uniform(0, 3)));
    const std::uint32_t count =
        random.uniform() < 0.8 ? most : static_cast<std::uint32_t>(random.uniform(0, most));
    std::vector<float> raw(count);
    std::vector<float> expected(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      raw[i] = reading(random);
      expected[i] = rays[i](raw[i], now_ns);
    }
    chain.push(header_of(now_ns, count), raw.data(), {0, 0, 0, 0}, state.data());
    SampleHeader header;
    std::vector<float> out(most);
    ASSERT_TRUE(chain.deliver({now_ns}, state.data(), &header, out.data()));
    ASSERT_EQ(header.count, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (std::isnan(expected[i])) {
        ASSERT_TRUE(std::isnan(out[i])) << "sample " << s << ", ray " << i << ": " << out[i];
      } else {
        ASSERT_EQ(out[i], expected[i]) << "sample " << s << ", ray " << i;
      }
    }
  }
  for (std::size_t i = chain.state_size(); i < state.size(); ++i) {
    ASSERT_EQ(state[i], std::byte{0xAB}) << "wrote beyond the state";
  }
}

TEST(RangeFilter, MediansAreThoseOfEachRay) {
  for (const int window : {1, 3, 5, 7, 9, 15, 31, 99}) {
    for (const std::uint32_t rays : {1U, 2U, 16U, 63U, 64U, 65U, 180U}) {
      SCOPED_TRACE(fmt::format("window {}, {} rays", window, rays));
      expect_as({.window = window}, rays, 3 * window + 40,
                PlainMedian(static_cast<std::size_t>(window)));
    }
  }
}

TEST(RangeFilter, ExponentialsAreThoseOfEachRay) {
  for (const double time_constant_s : {1e-4, 0.03, 5.0}) {
    for (const std::uint32_t rays : {1U, 2U, 16U, 65U, 180U}) {
      SCOPED_TRACE(fmt::format("T {}, {} rays", time_constant_s, rays));
      expect_as({.kind = FilterSpec::Kind::kExponential, .time_constant_s = time_constant_s}, rays,
                200, PlainExponential(time_constant_s));
    }
  }
}

TEST(RangeFilter, IsTheSameWithAllInstructions) {
  const int targets = for_each_target([](const char* name) {
    SCOPED_TRACE(name);
    for (const std::uint32_t rays : {3U, 16U, 77U}) {
      expect_as({.window = 5}, rays, 60, PlainMedian(5));
      expect_as({.kind = FilterSpec::Kind::kExponential, .time_constant_s = 0.03}, rays, 60,
                PlainExponential(0.03));
    }
  });
  EXPECT_GE(targets, 2) << "a processor with one set of instructions shows nothing";
}

TEST(RangeFilter, ResetForgetsTheReadings) {
  for (const FilterSpec& filter :
       {FilterSpec{.window = 5},
        FilterSpec{.kind = FilterSpec::Kind::kExponential, .time_constant_s = 1}}) {
    const Processing chain = made({.filters = {filter}}, ReadingKind::kRanges, 3);
    std::vector<std::byte> state = fresh_state(chain);
    const std::vector<std::byte> fresh = state;
    for (int run = 0; run < 2; ++run) {
      const float raw[3] = {1, 2.0F + static_cast<float>(run), kNoReturn};
      SampleHeader header;
      float out[3];
      chain.push(header_of(kTick_ns, 3), raw, {0, 0, 0, 0}, state.data());
      ASSERT_TRUE(chain.deliver({kTick_ns}, state.data(), &header, out));
      EXPECT_EQ(out[1], raw[1]);
      chain.reset(state.data());
      EXPECT_EQ(state, fresh);
    }
  }
}

}  // namespace
}  // namespace rave
