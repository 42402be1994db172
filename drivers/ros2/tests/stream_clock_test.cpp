// SPDX-License-Identifier: Apache-2.0
#include "ros2/stream_clock.hpp"

#include <gtest/gtest.h>

namespace rave::ros2_driver {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kEpoch_ns = 1'700'000'000'000 * kMs;

TEST(Ros2StreamClock, JitterOfTheWayIsTakenOut) {
  StreamClock clock;
  for (int i = 0; i < 500; ++i) {
    const double late_s = 0.001 * (i * 7 % 5);
    const auto taken = clock.take(kEpoch_ns + i * 20 * kMs, 50 + 0.02 * i + 0.003 + late_s);
    ASSERT_TRUE(taken.good);
    if (i > 50) {
      EXPECT_NEAR(taken.host_s, 50 + 0.02 * i + 0.003, 1e-4);
    }
  }
  EXPECT_EQ(clock.old(), 0U);
}

TEST(Ros2StreamClock, MessagesThatFallBehindAreLateWhateverTheirNumber) {
  StreamClock clock;
  for (int i = 0; i < 400; ++i) (void)clock.take(kEpoch_ns + i * 100 * kMs, 50 + 0.1 * i);
  double lag_s = 0;
  for (int i = 400; i < 4000; ++i) {
    lag_s = std::min(lag_s + 0.01, 3.0);
    const auto taken = clock.take(kEpoch_ns + i * 100 * kMs, 50 + 0.1 * i + lag_s);
    ASSERT_TRUE(taken.good);
    EXPECT_FALSE(taken.anew);
    // Half a second of lag takes 5 s, in which a clock may drift by 2.5 ms.
    EXPECT_NEAR(taken.host_s, 50 + 0.1 * i, 5e-3);
  }
  EXPECT_EQ(clock.restarts(), 0U);
}

TEST(Ros2StreamClock, AClockThatIsSetForwardAndBackIsLearntAnewAndTold) {
  StreamClock clock;
  for (int i = 0; i < 100; ++i) (void)clock.take(kEpoch_ns + i * 100 * kMs, 50 + 0.1 * i);
  int i = 100;
  const auto send = [&](std::int64_t ahead_ms) {
    const auto taken = clock.take(kEpoch_ns + (i * 100 + ahead_ms) * kMs, 50 + 0.1 * i);
    ++i;
    return taken;
  };
  // One stamp that is wrong is refused, and the next right one is good.
  EXPECT_FALSE(send(60'000).good);
  EXPECT_TRUE(send(0).good);
  EXPECT_EQ(clock.early(), 1U);
  for (const std::int64_t ahead_ms : {60'000, -60'000}) {
    for (int n = 0; n < 9; ++n) EXPECT_FALSE(send(ahead_ms).good);
    const double now_s = 50 + 0.1 * i;
    const auto taken = send(ahead_ms);
    EXPECT_TRUE(taken.good);
    EXPECT_TRUE(taken.anew);
    EXPECT_NEAR(taken.host_s, now_s, 1e-6);
    for (int n = 0; n < 100; ++n) EXPECT_FALSE(send(ahead_ms).anew);
  }
  EXPECT_EQ(clock.restarts(), 2U);
}

TEST(Ros2StreamClock, WithoutAStampItIsTrueOnArrival) {
  StreamClock clock;
  EXPECT_EQ(clock.take(0, 12.5).host_s, 12.5);
  EXPECT_TRUE(clock.take(0, 12.5).good);
}

TEST(Ros2StreamClock, OldOnesAreDroppedAndARestartIsNoticed) {
  StreamClock clock;
  EXPECT_TRUE(clock.take(5000 * kMs, 1).good);
  EXPECT_FALSE(clock.take(5000 * kMs, 1.1).good) << "twice";
  EXPECT_FALSE(clock.take(4000 * kMs, 1.2).good) << "out of order";
  EXPECT_TRUE(clock.take(5100 * kMs, 1.3).good);
  EXPECT_EQ(clock.old(), 2U);
  int dropped = 0;
  while (!clock.take((10 + dropped) * kMs, 2 + 0.001 * dropped).good) ++dropped;
  EXPECT_EQ(dropped, 9);
  EXPECT_EQ(clock.restarts(), 1U);
}

}  // namespace
}  // namespace rave::ros2_driver
