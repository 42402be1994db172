// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "rave/driver_testing/drive_fixture.hpp"
#include "rave/driver_testing/step_response.hpp"

namespace rave {
namespace {

class SkidSteerTest : public testing::DriveTest {
 protected:
  SkidSteerTest() : DriveTest("skid_steer_drive") {}
  void SetUp() override {
    driver.params.set("wheel_separation_m", 0.4)
        .set("slide_factor", 2)
        .set("turn_centre_m", 0.1)
        .set("max_wheel_speed_mps", 1.2);
    driver.start();
  }
};

class DynamicSkidSteerTest : public testing::DriveTest {
 protected:
  DynamicSkidSteerTest() : DriveTest("skid_steer_drive_dynamic") {}
  void SetUp() override {
    driver.params.set("wheel_separation_m", 0.4)
        .set("slide_factor", 2)
        .set("turn_centre_m", 0.1)
        .set("max_wheel_speed_mps", 1.2)
        .set("natural_frequency_radps", 10)
        .set("damping_ratio", 0.5)
        .set("max_wheel_acceleration_mps2", 1000);
  }
};

TEST_F(SkidSteerTest, TurnsAboutItsTurnCentreAsIfItWereWider) {
  const Twist2 out = step(velocity_command(0.5, 1));
  EXPECT_DOUBLE_EQ(out.vx, 0.5);
  EXPECT_DOUBLE_EQ(out.wz, 1);
  EXPECT_DOUBLE_EQ(out.vy, -0.1) << "0.1 m ahead of the origin nothing slides sideways";
  // On the spot the sides have 1.2 m/s at 0.4 m from the middle, twice what is built.
  EXPECT_NEAR(step(velocity_command(0, 100)).wz, 3, 1e-12);
}

TEST_F(SkidSteerTest, SaysWhatItsCommandsDo) {
  for (const Command& command : {velocity_command(0.3, -1), velocity_command(9, 2), Command{}}) {
    EXPECT_EQ(motion_of(command), step(command));
    EXPECT_EQ(motion_of(command_for(motion_of(command))), motion_of(command));
  }
}

TEST_F(DynamicSkidSteerTest, StepResponseIsTheTextbooks) {
  driver.start();
  for (std::uint32_t k = 0; k < 1500; ++k) {
    const double share = testing::underdamped(10, 0.5, kDt_s * (k + 1));
    const Twist2 out = step(velocity_command(0.5, 0.8), k);
    ASSERT_NEAR(out.vx, 0.5 * share, 1e-9) << k;
    ASSERT_NEAR(out.wz, 0.8 * share, 1e-9) << k;
    ASSERT_NEAR(out.vy, -0.08 * share, 1e-9) << k;
  }
}

TEST_F(DynamicSkidSteerTest, ASideThatSlipsTurnsIt) {
  driver.params.set("slip_probability_per_s", 2);
  driver.start();
  int turned = 0;
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    turned += std::abs(step(velocity_command(0.5, 0), k).wz) > 0.1 ? 1 : 0;
  }
  EXPECT_GT(turned, 1000);
}

}  // namespace
}  // namespace rave
