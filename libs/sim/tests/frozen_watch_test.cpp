// SPDX-License-Identifier: Apache-2.0
#include "../src/frozen_watch.hpp"

#include <gtest/gtest.h>

namespace rave::sim {
namespace {

/// Tells the robot `told` for some periods of 0.1 s, with a sample in each.
void watch_drive(FrozenWatch& watch, const Twist2& told, int periods, bool same = true) {
  for (int i = 0; i < periods; ++i) {
    watch.note_told(told, 0.1);
    watch.note_sample(same);
  }
}

TEST(FrozenWatch, TheSameAgainAndAgainWhileItIsToldToMoveIsFrozen) {
  for (const Twist2& told :
       {Twist2{0.2, 0, 0}, Twist2{-0.2, 0, 0}, Twist2{0, 0, 0.5}, Twist2{0, 0, -0.5}}) {
    FrozenWatch watch(0.55);
    watch_drive(watch, told, 5);
    EXPECT_FALSE(watch.is_frozen()) << "its drive may still have to begin";
    watch_drive(watch, told, 1);
    EXPECT_TRUE(watch.is_frozen());
    // It stands then, and so does what the sensor says.
    watch_drive(watch, Twist2{0, 0, 0}, 100);
    EXPECT_TRUE(watch.is_frozen());
    watch_drive(watch, Twist2{0, 0, 0}, 1, false);
    EXPECT_FALSE(watch.is_frozen());
  }
}

TEST(FrozenWatch, WhoStandsSeesTheSame) {
  FrozenWatch watch(0.55);
  watch_drive(watch, Twist2{0, 0, 0}, 1000);
  EXPECT_FALSE(watch.is_frozen());
  EXPECT_EQ(watch.told_s(), 0);
}

TEST(FrozenWatch, WhatChangesNowAndThenIsAlive) {
  FrozenWatch watch(0.55);
  for (int i = 0; i < 100; ++i) {
    watch_drive(watch, Twist2{0.2, 0, 0}, 5);
    EXPECT_FALSE(watch.is_frozen());
    EXPECT_NEAR(watch.told_s(), 0.5, 1e-9);
    watch_drive(watch, Twist2{0.2, 0, 0}, 1, false);
    EXPECT_EQ(watch.told_s(), 0);
  }
}

TEST(FrozenWatch, AMotionThatNoSensorCouldNoticeProvesNothing) {
  FrozenWatch watch(0.55);
  watch_drive(watch, Twist2{0.001, 0, 0.002}, 100);
  EXPECT_FALSE(watch.is_frozen());
  watch_drive(watch, Twist2{0.001, 0, 0.002}, 500);
  EXPECT_TRUE(watch.is_frozen());
}

TEST(FrozenWatch, ASlowSensorHasSaidTheSameOnlyOnce) {
  FrozenWatch watch(0.55);
  watch.note_told(Twist2{0.5, 0, 0}, 10);
  EXPECT_EQ(watch.told_s(), 0) << "nothing has come";
  watch.note_sample(true);
  watch.note_sample(true);
  EXPECT_FALSE(watch.is_frozen());
  watch.note_sample(true);
  EXPECT_TRUE(watch.is_frozen());
  watch.reset();
  EXPECT_FALSE(watch.is_frozen());
}

TEST(FrozenWatch, ItIsOffForSourcesWithoutNoise) {
  FrozenWatch watch(0);
  watch_drive(watch, Twist2{0.5, 0, 0.5}, 1000);
  EXPECT_FALSE(watch.is_frozen());
}

}  // namespace
}  // namespace rave::sim
