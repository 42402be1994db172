// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/driver_testing/drive_fixture.hpp"
#include "rave/driver_testing/step_response.hpp"

namespace rave {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class AckermannDriveTest : public testing::DriveTest {
 protected:
  AckermannDriveTest() : DriveTest("ackermann_drive") {}
  void SetUp() override {
    driver.params.set("wheel_base_m", 0.5)
        .set("max_steering_deg", 30)
        .set("max_speed_mps", 2)
        .set("max_reverse_mps", 1);
    driver.start();
  }
};

class DynamicCarTest : public testing::DriveTest {
 protected:
  DynamicCarTest() : DriveTest("ackermann_drive_dynamic") {}
  void SetUp() override {
    driver.params.set("wheel_base_m", 0.5)
        .set("max_steering_deg", 30)
        .set("max_speed_mps", 2)
        .set("max_reverse_mps", 1)
        .set("max_braking_mps2", 2)
        .set("max_steering_rate_degps", 60)
        .set("natural_frequency_radps", 10)
        .set("damping_ratio", 0.5)
        .set("max_wheel_acceleration_mps2", 1000);
  }
};

const double kNarrowest = tan(deg_to_rad(30)) / 0.5;  // 1/m

TEST_F(AckermannDriveTest, DrivesTheCircleOfItsSteering) {
  const Twist2 out = step(pedals_command(0.5, 0.25, 0, 1));
  EXPECT_DOUBLE_EQ(out.vx, 0.5);
  EXPECT_DOUBLE_EQ(out.vy, 0);
  EXPECT_NEAR(out.wz, 0.5 * tan(deg_to_rad(15)) / 0.5, 1e-12);
  const Twist2 back = step(pedals_command(-1, 1, 0, -1));
  EXPECT_DOUBLE_EQ(back.vx, -1);
  EXPECT_NEAR(back.wz, kNarrowest, 1e-12) << "to the right, backward: the nose goes left";
}

TEST_F(AckermannDriveTest, OnlyTheGearLetsItReverse) {
  EXPECT_EQ(step(pedals_command(0.3, 1, 0, 0)), Twist2{}) << "neutral";
  EXPECT_GE(step(pedals_command(0, -1, 0, 1)).vx, 0);
  EXPECT_GT(step(pedals_command(0, 1, 0, 1)).vx, 0);
  EXPECT_LT(step(pedals_command(0, 1, 0, -1)).vx, 0);
  EXPECT_DOUBLE_EQ(step(pedals_command(0, 1, 0.5, 1)).vx, 1) << "half a brake";
  EXPECT_EQ(step(pedals_command(0, 1, 1, 1)).vx, 0);
}

TEST_F(AckermannDriveTest, VelocitiesBecomeTheNearestThatACarCan) {
  const Twist2 out = step(velocity_command(1, 0.5));
  EXPECT_NEAR(out.vx, 1, 1e-12);
  EXPECT_NEAR(out.wz, 0.5, 1e-12);
  EXPECT_NEAR(step(velocity_command(1, 5)).wz, kNarrowest, 1e-12) << "the narrowest curve";
  EXPECT_EQ(step(velocity_command(0, 1)), Twist2{}) << "it does not turn on the spot";
  const Twist2 fast = step(velocity_command(8, 2));
  EXPECT_NEAR(fast.vx, 2, 1e-12);
  EXPECT_NEAR(fast.wz, 0.5, 1e-12) << "the curve stays";
  EXPECT_NEAR(step(velocity_command(-0.5, 0.2)).wz, 0.2, 1e-12);
}

TEST_F(AckermannDriveTest, StandsWithItsFootOnTheBrake) {
  EXPECT_EQ(command_for({}), pedals_command(0, 0, 1, 1));
  for (const Command& command : {Command{}, goal_command(1, 1), pedals_command(kNaN, 1, 0, 1),
                                 pedals_command(0, kNaN, 0, 1), velocity_command(kNaN, 0)}) {
    EXPECT_EQ(step(command), Twist2{});
  }
}

TEST_F(AckermannDriveTest, SaysWhatItsCommandsDo) {
  for (const double steering : {-1.0, -0.3, 0.0, 0.8}) {
    for (const double gear : {-1.0, 1.0}) {
      const Command command = pedals_command(steering, 0.6, 0, gear);
      const Twist2 motion = motion_of(command);
      EXPECT_EQ(motion, step(command));
      const Twist2 again = motion_of(command_for(motion));
      EXPECT_NEAR(again.vx, motion.vx, 1e-12);
      EXPECT_NEAR(again.wz, motion.wz, 1e-12);
    }
  }
}

TEST_F(DynamicCarTest, StepResponseIsTheTextbooks) {
  driver.start();
  for (std::uint32_t k = 0; k < 1500; ++k) {
    const double v_mps = step(pedals_command(0, 0.5, 0, 1), k).vx;
    ASSERT_NEAR(v_mps, testing::underdamped(10, 0.5, kDt_s * (k + 1)), 1e-9) << k;
  }
}

TEST_F(DynamicCarTest, TheSteeringTakesItsTime) {
  driver.start();
  for (std::uint32_t k = 0; k < 4000; ++k) step(pedals_command(0, 0.5, 0, 1), k);
  // 60 degrees a second: 250 ms to half of 30 degrees.
  Twist2 out;
  for (std::uint32_t k = 0; k < 250; ++k) out = step(pedals_command(1, 0.5, 0, 1), k);
  EXPECT_NEAR(out.wz / out.vx, tan(deg_to_rad(15)) / 0.5, 1e-6);
  for (std::uint32_t k = 0; k < 300; ++k) out = step(pedals_command(1, 0.5, 0, 1), k);
  EXPECT_NEAR(out.wz / out.vx, kNarrowest, 1e-9);
}

TEST_F(DynamicCarTest, BrakesAsHardAsThePedalAndThenStands) {
  driver.params.set("max_wheel_acceleration_mps2", 0.1).set("natural_frequency_radps", 100);
  for (const double brake : {1.0, 0.5}) {
    driver.start();
    MotionInput pushed;
    pushed.command = pedals_command(0, 0, brake, 1);
    pushed.dt_s = kDt_s;
    pushed.velocity = {1, 0, 0};
    pushed.contact = 1;
    double v_mps = driver.propose(pushed).vx;
    double way_m = 0;
    for (std::uint32_t k = 0; k < 5000 && v_mps > 0; ++k) {
      v_mps = step(pedals_command(0, 0, brake, 1), k).vx;
      ASSERT_GE(v_mps, 0) << "a brake turns nothing round";
      way_m += v_mps * kDt_s;
    }
    EXPECT_EQ(v_mps, 0);
    EXPECT_NEAR(way_m, 1 / (2 * 2 * brake), 0.02);  // v^2 / 2a
  }
}

TEST_F(DynamicCarTest, AGearThatForbidsADirectionDoes) {
  driver.params.set("damping_ratio", 0.05);
  driver.start();
  for (std::uint32_t k = 0; k < 3000; ++k) step(pedals_command(0, 0.5, 0, 1), k);
  for (std::uint32_t k = 0; k < 3000; ++k) {
    ASSERT_GE(step(pedals_command(0, 0, 0, 1), k).vx, 0) << "it would swing far below zero";
  }
  double least_mps = 0;
  for (std::uint32_t k = 0; k < 3000; ++k) {
    least_mps = std::min(least_mps, step(pedals_command(0, 0.5, 0, -1), k).vx);
  }
  EXPECT_LT(least_mps, -0.4);
}

TEST_F(DynamicCarTest, BrakesWithoutACommand) {
  driver.start();
  for (std::uint32_t k = 0; k < 2000; ++k) step(pedals_command(0.2, 0.5, 0, 1), k);
  Twist2 out;
  for (std::uint32_t k = 0; k < 1000; ++k) out = step({}, k);
  EXPECT_EQ(out, Twist2{});
}

}  // namespace
}  // namespace rave
