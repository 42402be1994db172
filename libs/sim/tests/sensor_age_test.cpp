// SPDX-License-Identifier: Apache-2.0
#include "../src/sensor_age.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "live_fixture.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kInfinite_s = std::numeric_limits<double>::infinity();

SensorSpec spec_of(SampleTiming timing) {
  SensorSpec spec;
  spec.name = "laser";
  spec.timing = timing;
  return spec;
}

TEST(SensorAge, ThreePeriodsAndAtLeastAFifthOfASecondAreTheLargest) {
  const SensorSpec spec = spec_of(SampleTiming::kPeriodic);
  HardwareDeclaration declaration;
  for (const auto& [period_s, largest_s] : {std::pair(0.02, 0.2), std::pair(0.1, 0.3)}) {
    declaration.period_s = period_s;
    const auto found = max_age_s(spec, declaration, std::nullopt);
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->has_value());
    EXPECT_DOUBLE_EQ(**found, largest_s);
  }
}

TEST(SensorAge, AProgramIsToldHalfAsMuchAgainAndTheLatencyOfTheFile) {
  SensorSpec spec = spec_of(SampleTiming::kPeriodic);
  spec.processing.latency_s = 0.1;
  SensorSlots slots;
  slots.spec = &spec;
  EXPECT_EQ(told_max_age_s(slots), kInfinite_s);
  slots.max_age_s = 0.4;
  EXPECT_DOUBLE_EQ(told_max_age_s(slots), 0.7);
  const SensorSpec events = spec_of(SampleTiming::kEvents);
  slots.spec = &events;
  EXPECT_EQ(told_max_age_s(slots), kInfinite_s) << "its age says nothing";
}

TEST(SensorAge, OfALiveSampleIsTheWallTimeSinceItWasTrue) {
  HandClock clock;
  clock.set(100);
  SampleQueue queue(ReadingKind::kValues, 1, 4, &clock);
  EXPECT_EQ(live_age_s(queue, false), kInfinite_s);
  const double value = 1;
  const auto before = std::chrono::steady_clock::now();
  for (const double lag_s : {40.0, 0.0}) {
    ASSERT_TRUE(queue.publish(clock.now() - from_seconds(lag_s), &value, 1));
    const double age_s = live_age_s(queue, false);
    const std::chrono::duration<double> most = std::chrono::steady_clock::now() - before;
    EXPECT_GE(age_s, lag_s);
    EXPECT_LE(age_s, lag_s + most.count());
  }
  // The wall clock goes on by itself; that of the run does not count.
  clock.advance(50);
  EXPECT_LT(live_age_s(queue, false), 50);
}

TEST(SensorAge, OfALinkIsNothingOrInfinite) {
  HandClock clock;
  SampleQueue queue(ReadingKind::kValues, 1, 4, &clock);
  EXPECT_EQ(live_age_s(queue, true), 0);
  queue.fail("gone", 4);
  EXPECT_EQ(live_age_s(queue, true), kInfinite_s);
}

TEST(SensorAge, TheTextSaysWhetherNothingComesOrTooLate) {
  const SensorSpec spec = spec_of(SampleTiming::kPeriodic);
  HandClock clock;
  clock.set(10);
  SensorSlots slots;
  slots.spec = &spec;
  slots.live = true;
  slots.max_age_s = 0.5;
  slots.queues.push_back(std::make_unique<SampleQueue>(ReadingKind::kValues, 1, 4, &clock));
  EXPECT_EQ(sensor_lost_text(slots, 0),
            "sensor lost: `laser` has given no sample for more than 0.5 s");
  const double value = 1;
  ASSERT_TRUE(slots.queues[0]->publish(clock.now() - from_seconds(3.1), &value, 1));
  EXPECT_EQ(sensor_lost_text(slots, 0),
            "sensor lost: the samples of `laser` come 3.1 s late, more than 0.5 s");
}

}  // namespace
}  // namespace rave::sim::testing
