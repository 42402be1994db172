// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/clock_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "rave/base/random.hpp"

namespace rave::bus {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Another clock that is ahead of ours and runs at a rate of its own, behind a line with a delay
/// each way.
struct Elsewhere {
  double ahead_ns = 0;
  double drift = 0;

  [[nodiscard]] std::int64_t at(std::int64_t ours_ns) const {
    return ours_ns + std::llround(ahead_ns + drift * static_cast<double>(ours_ns));
  }
  [[nodiscard]] ClockExchange exchange(std::int64_t now_ns, std::int64_t there_ns,
                                       std::int64_t back_ns, std::int64_t held_ns = 1000) const {
    const std::int64_t arrived = now_ns + there_ns;
    return {now_ns, at(arrived), at(arrived + held_ns), arrived + held_ns + back_ns};
  }
};

TEST(ReadClock, IsExactIfBothWaysTakeEquallyLong) {
  const Elsewhere clock{7e12};
  const auto reading = read_clock(clock.exchange(5 * kMs, kMs, kMs));
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->offset.ns, 7'000'000'000'000);
  EXPECT_EQ(reading->bound.ns, kMs + 1);
}

TEST(ReadClock, IsWrongByHalfTheDifferenceAndItsBoundSaysSo) {
  const Elsewhere clock{-3e9};
  const auto slow_there = read_clock(clock.exchange(0, 9 * kMs, kMs));
  const auto slow_back = read_clock(clock.exchange(0, kMs, 9 * kMs));
  ASSERT_TRUE(slow_there && slow_back);
  EXPECT_EQ(slow_there->offset.ns, -3'000'000'000 + 4 * kMs);
  EXPECT_EQ(slow_back->offset.ns, -3'000'000'000 - 4 * kMs);
  EXPECT_EQ(slow_there->bound.ns, 5 * kMs + 1);
}

TEST(ReadClock, TheBoundHoldsForAnyDelays) {
  RandomStream chance(1, 0, 0, 0);
  for (int i = 0; i < 10'000; ++i) {
    const Elsewhere clock{chance.uniform(-1e15, 1e15)};
    const auto there = static_cast<std::int64_t>(chance.uniform(0, 1e7));
    const auto back = static_cast<std::int64_t>(chance.uniform(0, 1e7));
    const auto held = static_cast<std::int64_t>(chance.uniform(0, 1e8));
    const auto reading = read_clock(clock.exchange(i, there, back, held));
    ASSERT_TRUE(reading);
    EXPECT_LE(std::llabs(reading->offset.ns - std::llround(clock.ahead_ns)), reading->bound.ns);
  }
}

TEST(ReadClock, RefusesWhatCannotBe) {
  const auto backwards = read_clock({10, 0, 0, 5});
  ASSERT_FALSE(backwards);
  EXPECT_EQ(backwards.error().message,
            "impossible clock exchange of -5 ns, of which 0 ns at the other end");
  EXPECT_FALSE(read_clock({0, 10, 5, 20}));   // Answered before it was asked.
  EXPECT_FALSE(read_clock({0, 10, 50, 20}));  // Held longer than it was away.
}

TEST(ClockOffset, KnowsNothingAtFirstAndAfterTheWindow) {
  ClockOffset offset({.window = Duration{100 * kMs}});
  EXPECT_FALSE(offset.at(0));
  ASSERT_TRUE(offset.add(Elsewhere{5}.exchange(0, kMs, kMs)));
  EXPECT_TRUE(offset.at(50 * kMs));
  EXPECT_FALSE(offset.at(200 * kMs));
}

TEST(ClockOffset, KeepsTheQuickestOfTheWindow) {
  const Elsewhere clock{1e9};
  ClockOffset offset({.window = Duration{1000 * kMs}, .max_drift = 0});
  ASSERT_TRUE(offset.add(clock.exchange(0, 8 * kMs, kMs)));
  ASSERT_TRUE(offset.add(clock.exchange(100 * kMs, kMs / 10, kMs / 10)));
  ASSERT_TRUE(offset.add(clock.exchange(200 * kMs, kMs, 8 * kMs)));
  EXPECT_EQ(offset.at(300 * kMs)->offset.ns, 1'000'000'000);
  EXPECT_EQ(offset.at(300 * kMs)->bound.ns, kMs / 10 + 1);
  // The quick one leaves the window; the slow one that came later is what is left.
  EXPECT_EQ(offset.at(1150 * kMs)->bound.ns, 9 * kMs / 2 + 1);
}

TEST(ClockOffset, FollowsAClockThatDriftsWithinItsBound) {
  const Elsewhere clock{4e11, 50e-6};
  ClockOffset offset({.window = Duration{10'000 * kMs}, .max_drift = 100e-6});
  RandomStream chance(2, 0, 0, 0);
  double worst_bound_ns = 0;
  for (std::int64_t now = 0; now < 600'000 * kMs; now += 250 * kMs) {
    // Mostly quick; every now and then the line is busy one way.
    const double busy = chance.uniform() < 0.3 ? 20.0 * static_cast<double>(kMs) : 0;
    const auto there = static_cast<std::int64_t>(chance.uniform(1e5, 2e5) + busy);
    const auto back = static_cast<std::int64_t>(chance.uniform(1e5, 2e5));
    ASSERT_TRUE(offset.add(clock.exchange(now, there, back)));
    const std::int64_t later = now + 200 * kMs;
    const auto reading = offset.at(later);
    ASSERT_TRUE(reading);
    const std::int64_t truth = clock.at(later) - later;
    ASSERT_LE(std::llabs(reading->offset.ns - truth), reading->bound.ns) << now;
    if (now > 10'000 * kMs) {
      worst_bound_ns = std::max(worst_bound_ns, static_cast<double>(reading->bound.ns));
    }
  }
  // Half a round trip and what a few exchanges in a row can lose to drift, not half the busy line.
  EXPECT_LT(worst_bound_ns, 1e6);
}

TEST(ClockOffset, DropsABadExchange) {
  ClockOffset offset;
  EXPECT_FALSE(offset.add({10, 0, 0, 5}));
  EXPECT_FALSE(offset.at(10));
}

}  // namespace
}  // namespace rave::bus
