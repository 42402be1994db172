// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/driver_testing/drive_fixture.hpp"
#include "rave/driver_testing/step_response.hpp"

namespace rave {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class QuadrotorTest : public testing::DriveTest {
 protected:
  QuadrotorTest() : DriveTest("quadrotor") {}
  void SetUp() override {
    driver.params.set("max_speed_mps", 2).set("max_turn_rate_radps", 1.5);
    driver.start();
  }
};

class DynamicQuadrotorTest : public testing::DriveTest {
 protected:
  DynamicQuadrotorTest() : DriveTest("quadrotor_dynamic") {}
  void SetUp() override {
    driver.params.set("max_speed_mps", 2)
        .set("max_turn_rate_radps", 1.5)
        .set("natural_frequency_radps", 10)
        .set("damping_ratio", 0.5)
        .set("max_tilt_deg", 80);
  }
};

TEST_F(QuadrotorTest, FliesInAnyDirectionWithinItsLimits) {
  EXPECT_EQ(step(velocity_command(1, 0.5, -1)), (Twist2{1, -1, 0.5}));
  const Twist2 fast = step(velocity_command(3, 9, 4));
  EXPECT_NEAR(fast.vx, 1.2, 1e-12);
  EXPECT_NEAR(fast.vy, 1.6, 1e-12);
  EXPECT_DOUBLE_EQ(fast.wz, 1.5);
}

TEST_F(QuadrotorTest, HoversWithoutAUsableCommand) {
  EXPECT_EQ(step({}), Twist2{});
  EXPECT_EQ(step(velocity_command(kNaN, 0)), Twist2{});
  EXPECT_EQ(step(velocity_command(1.7e308, 0, 1.7e308)), Twist2{});
  EXPECT_EQ(motion_of(command_for({0.5, -0.25, 1})), (Twist2{0.5, -0.25, 1}));
}

TEST_F(DynamicQuadrotorTest, StepResponseIsTheTextbooks) {
  driver.start();
  for (std::uint32_t k = 0; k < 1500; ++k) {
    const double share = testing::underdamped(10, 0.5, kDt_s * (k + 1));
    const Twist2 out = step(velocity_command(0.5, 0.4, -0.5), k);
    ASSERT_NEAR(out.vx, 0.5 * share, 1e-9) << k;
    ASSERT_NEAR(out.vy, -0.5 * share, 1e-9) << k;
    ASSERT_NEAR(out.wz, 0.4 * share, 1e-9) << k;
  }
}

TEST_F(DynamicQuadrotorTest, TheTiltLimitsItsAcceleration) {
  driver.params.set("max_tilt_deg", 10).set("natural_frequency_radps", 100);
  driver.start();
  double v_mps = 0;
  for (std::uint32_t k = 0; k < 500; ++k) v_mps = step(velocity_command(2, 0), k).vx;
  EXPECT_NEAR(v_mps, 9.80665 * tan(deg_to_rad(10)) * 0.5, 1e-9);
}

TEST_F(DynamicQuadrotorTest, GustsComeAsOftenAndLastAsLongAsTheySay) {
  driver.params.set("gust_probability_per_s", 2).set("gust_mps", 0.5).set("gust_duration_s", 0.1);
  driver.start();
  int drifting = 0;
  constexpr std::uint32_t kSteps = 500'000;
  for (std::uint32_t k = 0; k < kSteps; ++k) {
    const Twist2 out = step(velocity_command(0, 0), k);
    const double drift_mps = std::sqrt(out.vx * out.vx + out.vy * out.vy);
    if (drift_mps == 0) continue;
    ASSERT_NEAR(drift_mps, 0.5, 1e-9);
    ++drifting;
  }
  // 0.5 s of still air on average, then 0.1 s of gust; about 833 gusts, standard deviation 24.
  EXPECT_NEAR(drifting / 100.0, kSteps * kDt_s / 0.6, 4 * 24);
}

}  // namespace
}  // namespace rave
