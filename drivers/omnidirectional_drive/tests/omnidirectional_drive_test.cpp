// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/driver_testing/drive_fixture.hpp"
#include "rave/driver_testing/step_response.hpp"

namespace rave {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class OmniDriveTest : public testing::DriveTest {
 protected:
  OmniDriveTest() : DriveTest("omnidirectional_drive") {}
  void SetUp() override {
    driver.params.set("wheels", 3)
        .set("wheel_circle_m", 0.2)
        .set("first_wheel_deg", 60)
        .set("max_wheel_speed_mps", 1);
    driver.start();
  }
};

class DynamicOmniTest : public testing::DriveTest {
 protected:
  DynamicOmniTest() : DriveTest("omnidirectional_drive_dynamic") {}
  void SetUp() override {
    driver.params.set("wheels", 3)
        .set("wheel_circle_m", 0.2)
        .set("first_wheel_deg", 60)
        .set("max_wheel_speed_mps", 1)
        .set("natural_frequency_radps", 10)
        .set("damping_ratio", 0.5)
        .set("max_wheel_acceleration_mps2", 1000);
  }
};

TEST_F(OmniDriveTest, GoesSidewaysAndTurnsAtOnce) {
  const Twist2 out = step(velocity_command(0.2, 0.5, -0.3));
  EXPECT_EQ(out, (Twist2{0.2, -0.3, 0.5}));
}

TEST_F(OmniDriveTest, NoWheelIsFasterThanItCanBe) {
  // Wheels at 60, 180 and 300 degrees. Ahead those at 60 and 300 turn, each with sin 60 of the
  // speed; to the left the one behind alone has all of it.
  EXPECT_NEAR(step(velocity_command(5, 0)).vx, 1 / sin(deg_to_rad(60)), 1e-12);
  EXPECT_NEAR(step(velocity_command(0, 0, 5)).vy, 1, 1e-12);
  EXPECT_NEAR(step(velocity_command(0, -50)).wz, -5, 1e-12);
  const Twist2 out = step(velocity_command(3, 2, 4));
  EXPECT_NEAR(out.vy / out.vx, 4.0 / 3, 1e-12) << "all is scaled alike";
  EXPECT_NEAR(out.wz / out.vx, 2.0 / 3, 1e-12);
}

TEST_F(OmniDriveTest, SaysWhatItsCommandsDo) {
  for (const Command& command : {velocity_command(0.3, -1, 0.1), velocity_command(9, 2, -4)}) {
    EXPECT_EQ(motion_of(command), step(command));
    const Twist2 again = motion_of(command_for(motion_of(command)));
    EXPECT_NEAR(again.vx, motion_of(command).vx, 1e-12);
    EXPECT_NEAR(again.vy, motion_of(command).vy, 1e-12);
  }
  EXPECT_EQ(command_for({}), velocity_command(0, 0));
}

TEST_F(OmniDriveTest, StandsWithoutAUsableCommand) {
  EXPECT_EQ(step({}), Twist2{});
  EXPECT_EQ(step(goal_command(1, 1)), Twist2{});
  EXPECT_EQ(step(velocity_command(0, 0, kNaN)), Twist2{});
  EXPECT_EQ(step(velocity_command(1.7e308, 1.7e308, 1.7e308)), Twist2{});
}

TEST_F(DynamicOmniTest, StepResponseIsTheTextbooksInAllDirections) {
  driver.start();
  for (std::uint32_t k = 0; k < 1500; ++k) {
    const double share = testing::underdamped(10, 0.5, kDt_s * (k + 1));
    const Twist2 out = step(velocity_command(0.3, 0.5, -0.2), k);
    ASSERT_NEAR(out.vx, 0.3 * share, 1e-9) << k;
    ASSERT_NEAR(out.vy, -0.2 * share, 1e-9) << k;
    ASSERT_NEAR(out.wz, 0.5 * share, 1e-9) << k;
  }
}

TEST_F(DynamicOmniTest, AWheelThatSlipsLeadsItAstray) {
  driver.params.set("slip_probability_per_s", 1);
  driver.start();
  int astray = 0;
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    const Twist2 out = step(velocity_command(0.5, 0), k);
    astray += std::abs(out.vy) + std::abs(out.wz) > 0.05 ? 1 : 0;
  }
  EXPECT_GT(astray, 1000);
}

}  // namespace
}  // namespace rave
