// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "programs/testing/driver_harness.hpp"

namespace rave {
namespace {

class DifferentialDriveTest : public ::testing::Test {
 protected:
  void SetUp() override {
    driver.params.set("wheel_separation_m", 0.4).set("max_wheel_speed_mps", 0.6);
    driver.start();
  }
  Twist2 answer(const Command& command) {
    MotionInput input;
    input.command = command;
    input.dt_s = 0.01;
    return driver.propose(input);
  }

  testing::ActuatorUnderTest driver{rave_register_plugin, "differential_drive"};
};

TEST_F(DifferentialDriveTest, ReachesWhatTheWheelsCanAtOnce) {
  const Twist2 out = answer(velocity_command(0.25, 1.0));
  EXPECT_DOUBLE_EQ(out.vx, 0.25);
  EXPECT_DOUBLE_EQ(out.vy, 0);
  EXPECT_DOUBLE_EQ(out.wz, 1.0);
}

TEST_F(DifferentialDriveTest, LimitsTheFasterWheelAndKeepsTheCurve) {
  // Wheels 0.8 and 1.2 m/s are scaled by 0.5.
  const Twist2 out = answer(velocity_command(1.0, 1.0));
  EXPECT_DOUBLE_EQ(out.vx, 0.5);
  EXPECT_DOUBLE_EQ(out.wz, 0.5);
  const Twist2 back = answer(velocity_command(-1.0, 1.0));
  EXPECT_DOUBLE_EQ(back.vx, -0.5);
  EXPECT_DOUBLE_EQ(back.wz, 0.5);
  // On the spot: both wheels at 0.6 m/s, 0.2 m from the middle.
  const Twist2 spin = answer(velocity_command(0, -50));
  EXPECT_DOUBLE_EQ(spin.vx, 0);
  EXPECT_DOUBLE_EQ(spin.wz, -3.0);
}

TEST_F(DifferentialDriveTest, StandsStillWithoutAUsableCommand) {
  EXPECT_EQ(answer({}), Twist2{});
  EXPECT_EQ(answer(goal_command(1, 1)), Twist2{});
  EXPECT_EQ(answer(velocity_command(std::numeric_limits<double>::quiet_NaN(), 0)), Twist2{});
  EXPECT_EQ(answer(velocity_command(0, std::numeric_limits<double>::infinity())), Twist2{});
}

}  // namespace
}  // namespace rave
