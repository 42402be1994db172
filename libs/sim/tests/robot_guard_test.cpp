// SPDX-License-Identifier: Apache-2.0
#include "../src/robot_guard.hpp"

#include <gtest/gtest.h>

namespace rave::sim {
namespace {

GuardInput forward(double v_mps) {
  GuardInput input;
  input.command = velocity_command(v_mps, 0);
  input.radius_m = 0.2;
  return input;
}

TEST(RobotGuard, AStopLatchesUntilItIsReleased) {
  RobotGuard guard;
  EXPECT_TRUE(guard.is_free());
  EXPECT_TRUE(guard.stop());
  EXPECT_FALSE(guard.stop()) << "it was stopped already";
  EXPECT_FALSE(guard.is_free());
  EXPECT_FALSE(guard.arm()) << "it was armed, which ends no stop";
  EXPECT_EQ(guard.limit(GuardSpec{}, forward(0.3)).command, velocity_command(0, 0));
  EXPECT_EQ(guard.limit(velocity_command(0.3, 0), CommandKind::kVelocity), velocity_command(0, 0));
  EXPECT_TRUE(guard.release(true));
  EXPECT_FALSE(guard.release(true)) << "it was released already";
  EXPECT_EQ(guard.limit(GuardSpec{}, forward(0.3)).command, velocity_command(0.3, 0));
}

TEST(RobotGuard, AReleasedRobotMayHaveToBeArmedAnew) {
  RobotGuard guard;
  EXPECT_TRUE(guard.stop());
  EXPECT_TRUE(guard.release(false));
  const GuardOutput unarmed = guard.limit(GuardSpec{}, forward(0.3));
  EXPECT_EQ(unarmed.command, velocity_command(0, 0));
  EXPECT_TRUE(unarmed.by(GuardLimit::kUnarmed));
  EXPECT_TRUE(guard.arm());
  EXPECT_EQ(guard.limit(GuardSpec{}, forward(0.3)).command, velocity_command(0.3, 0));
}

TEST(RobotGuard, ARobotThatIsHandedOverStandsWithLimitsAndWithout) {
  RobotGuard guard;
  guard.hold(true);
  const GuardOutput held = guard.limit(GuardSpec{}, forward(0.3));
  EXPECT_EQ(held.command, velocity_command(0, 0));
  EXPECT_EQ(held.acted, 0U) << "nothing that a limit did";
  EXPECT_EQ(guard.limit(velocity_command(0.3, 0), CommandKind::kVelocity), velocity_command(0, 0));
  EXPECT_EQ(guard.limit(Command{CommandKind::kJoint, 1, {0.3}}, CommandKind::kJoint), Command{});
  guard.hold(false);
  EXPECT_EQ(guard.limit(GuardSpec{}, forward(0.3)).command, velocity_command(0.3, 0));
}

TEST(RobotGuard, HoldsOfTheInputDoNotCount) {
  RobotGuard guard;
  GuardInput input = forward(0.3);
  input.stopped = true;
  input.armed = false;
  EXPECT_EQ(guard.limit(GuardSpec{}, input).command, velocity_command(0.3, 0));
}

TEST(RobotGuard, ALimitBeginsAnewOnlyAfterItWasQuietForLonger) {
  RobotGuard guard;
  constexpr std::uint32_t kFence = 1U << static_cast<unsigned>(GuardLimit::kFence);
  constexpr std::uint32_t kSpeed = 1U << static_cast<unsigned>(GuardLimit::kSpeed);
  EXPECT_EQ(guard.begin(kFence, 0, 50), kFence);
  EXPECT_EQ(guard.begin(kFence, 10, 50), 0U);
  EXPECT_EQ(guard.begin(kFence | kSpeed, 20, 50), kSpeed);
  EXPECT_EQ(guard.begin(kFence, 70, 50), 0U);
  EXPECT_EQ(guard.begin(kFence, 121, 50), kFence);
  EXPECT_EQ(guard.begin(0, 1000, 50), 0U);
}

TEST(RobotGuard, SlowIsAnotherEventThanStop) {
  GuardSpec limits;
  EXPECT_EQ(event_of(GuardLimit::kFence, limits), EventKind::kGuardSlowed);
  EXPECT_EQ(event_of(GuardLimit::kWorldLost, limits), EventKind::kGuardStopped);
  limits.world_lost = WorldLostPolicy::kSlow;
  EXPECT_EQ(event_of(GuardLimit::kWorldLost, limits), EventKind::kGuardSlowed);
}

}  // namespace
}  // namespace rave::sim
