// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "programs/testing/driver_harness.hpp"

namespace rave {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class VelocityControllerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    driver.params.set("max_speed_mps", 0.5).set("max_turn_rate_radps", 1.5).set("watchdog_s", 0.5);
    driver.start();
  }
  Command answer(const Command& command, double age_s = 0) {
    ControlInput input;
    input.command = command;
    input.command_age_s = age_s;
    return driver.control(input);
  }

  testing::ControllerUnderTest driver{rave_register_plugin, "velocity"};
};

TEST_F(VelocityControllerTest, PassesOnWhatIsWithinTheLimits) {
  EXPECT_EQ(answer(velocity_command(0.3, -1.2)), velocity_command(0.3, -1.2));
}

TEST_F(VelocityControllerTest, LimitsEachWay) {
  EXPECT_EQ(answer(velocity_command(9, -9)), velocity_command(0.5, -1.5));
  EXPECT_EQ(answer(velocity_command(-9, 9)), velocity_command(-0.5, 1.5));
}

TEST_F(VelocityControllerTest, LimitsTheSpeedOfOneThatMovesSideways) {
  EXPECT_EQ(answer(velocity_command(0.3, 1, -0.4)), velocity_command(0.3, 1, -0.4));
  const Command out = answer(velocity_command(0.6, 9, -0.8));
  EXPECT_NEAR(out.value[0], 0.3, 1e-12);
  EXPECT_EQ(out.value[1], 1.5);
  EXPECT_NEAR(out.value[2], -0.4, 1e-12);
  EXPECT_EQ(answer(velocity_command(0.3, 1, kNaN)), velocity_command(0, 0));
}

TEST_F(VelocityControllerTest, StopsWhenCommandsStopComing) {
  EXPECT_EQ(answer(velocity_command(0.3, 1), 0.5), velocity_command(0.3, 1));
  EXPECT_EQ(answer(velocity_command(0.3, 1), 0.51), velocity_command(0, 0));
  EXPECT_EQ(answer(velocity_command(0.3, 1), kNaN), velocity_command(0, 0));
}

TEST_F(VelocityControllerTest, StopsBeforeTheFirstCommandAndForOtherKinds) {
  EXPECT_EQ(answer({}), velocity_command(0, 0));
  EXPECT_EQ(answer(goal_command(0.3, 0.2)), velocity_command(0, 0));
  EXPECT_TRUE(driver.log.lines.empty());
}

TEST_F(VelocityControllerTest, StopsForWhatIsNotANumberAndSaysSoOnce) {
  EXPECT_EQ(answer(velocity_command(kNaN, 0)), velocity_command(0, 0));
  EXPECT_EQ(answer(velocity_command(0.3, kInfinity)), velocity_command(0, 0));
  ASSERT_EQ(driver.log.lines.size(), 1U);
  EXPECT_NE(driver.log.lines[0].find("v = nan m/s, w = 0 rad/s"), std::string::npos)
      << driver.log.lines[0];
  EXPECT_EQ(answer(velocity_command(0.2, 0)), velocity_command(0.2, 0));
}

}  // namespace
}  // namespace rave
