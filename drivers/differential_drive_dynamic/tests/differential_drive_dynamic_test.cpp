// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "../second_order.hpp"
#include "programs/testing/driver_harness.hpp"
#include "rave/driver_testing/step_response.hpp"
#include "rave/math/scalar.hpp"

namespace rave {
namespace {

constexpr double kDt_s = 0.001;

class DynamicDriveTest : public ::testing::Test {
 protected:
  void SetUp() override {
    driver.step_s = kDt_s;
    driver.params.set("wheel_separation_m", 0.4)
        .set("max_wheel_speed_mps", 5)
        .set("natural_frequency_radps", 10)
        .set("damping_ratio", 0.5)
        .set("max_wheel_acceleration_mps2", 1000);
  }
  Twist2 step(const Command& command, std::uint32_t number, double dt_s = kDt_s) {
    MotionInput input;
    input.command = command;
    input.dt_s = dt_s;
    input.seed = 7;
    input.step = number;
    return driver.propose(input);
  }
  /// Forward speeds after 1, 2, ... steps of a command of 1 m/s.
  std::vector<double> response(int steps, double dt_s = kDt_s) {
    driver.start();
    std::vector<double> speeds_mps;
    for (int k = 0; k < steps; ++k) {
      speeds_mps.push_back(step(velocity_command(1, 0), static_cast<std::uint32_t>(k), dt_s).vx);
    }
    return speeds_mps;
  }

  testing::ActuatorUnderTest driver{rave_register_plugin, "differential_drive_dynamic"};
};

TEST_F(DynamicDriveTest, StepResponseIsTheTextbooks) {
  for (const double zeta : {0.2, 0.5, 0.8}) {
    driver.params.set("damping_ratio", zeta);
    const std::vector<double> speeds_mps = response(2000);
    for (std::size_t k = 0; k < speeds_mps.size(); ++k) {
      const double t_s = kDt_s * static_cast<double>(k + 1);
      ASSERT_NEAR(speeds_mps[k], testing::underdamped(10, zeta, t_s), 1e-9)
          << zeta << " at " << t_s;
    }
    const double root = std::sqrt(1.0 - zeta * zeta);
    const auto peak = std::max_element(speeds_mps.begin(), speeds_mps.end());
    EXPECT_NEAR(*peak - 1.0, exp(-kPi * zeta / root), 1e-5) << zeta;
    EXPECT_NEAR(kDt_s * static_cast<double>(peak - speeds_mps.begin() + 1), kPi / (10.0 * root),
                kDt_s);
  }
}

TEST_F(DynamicDriveTest, RiseTimeIsTheTextbooks) {
  // 10 % to 90 % at zeta = 0.5 takes 1.64 / omega (Franklin et al. round it to 1.8 for all zeta).
  const std::vector<double> speeds_mps = response(2000);
  const auto passed = [&](double level) {
    return kDt_s * static_cast<double>(std::find_if(speeds_mps.begin(), speeds_mps.end(),
                                                    [&](double s) { return s >= level; }) -
                                       speeds_mps.begin() + 1);
  };
  EXPECT_NEAR(passed(0.9) - passed(0.1), 1.638 / 10.0, 0.002);
}

TEST_F(DynamicDriveTest, CriticalAndStrongDampingDoNotOvershoot) {
  driver.params.set("damping_ratio", 1.0);
  std::vector<double> speeds_mps = response(1000);
  EXPECT_NEAR(speeds_mps[99], 1.0 - exp(-1.0) * 2.0, 1e-9);  // 1 - (1 + wt) exp(-wt) at wt = 1
  driver.params.set("damping_ratio", 4.0);
  speeds_mps = response(3000);
  EXPECT_TRUE(std::is_sorted(speeds_mps.begin(), speeds_mps.end()));
  EXPECT_LT(speeds_mps.back(), 1.0);
  EXPECT_GT(speeds_mps.back(), 0.97);
}

TEST_F(DynamicDriveTest, TheStepDoesNotChangeTheMotion) {
  const double fine_mps = response(200)[199];
  EXPECT_NEAR(response(4, 0.05)[3], fine_mps, 1e-10);
}

TEST_F(DynamicDriveTest, MotorLagComesOnTop) {
  // With a fast, well damped control what is left is 1 - exp(-t / T).
  driver.params.set("motor_time_constant_s", 0.5)
      .set("natural_frequency_radps", 1000)
      .set("damping_ratio", 1);
  EXPECT_NEAR(response(500)[499], 1.0 - exp(-1.0), 0.002);
}

TEST_F(DynamicDriveTest, AccelerationIsLimited) {
  driver.params.set("max_wheel_acceleration_mps2", 0.5);
  const std::vector<double> speeds_mps = response(6000);
  double before_mps = 0;
  for (const double speed_mps : speeds_mps) {
    ASSERT_LE(std::abs(speed_mps - before_mps), 0.5 * kDt_s + 1e-12);
    before_mps = speed_mps;
  }
  EXPECT_NEAR(speeds_mps[999], 0.5, 0.05);  // 0.5 m/s^2 for 1 s
  EXPECT_NEAR(speeds_mps.back(), 1.0, 0.01);
}

TEST_F(DynamicDriveTest, AContactMakesItStartAnewFromWhatTheWorldAllowed) {
  driver.start();
  for (std::uint32_t k = 0; k < 150; ++k) step(velocity_command(1, 0), k);
  MotionInput input;
  input.command = velocity_command(0.2, 1.0);
  input.velocity = {0.2, 0.1, 1.0};
  input.contact = 1;
  input.dt_s = kDt_s;
  const Twist2 out = driver.propose(input);
  // It already has what it wants and no acceleration, so it keeps it.
  EXPECT_NEAR(out.vx, 0.2, 1e-12);
  EXPECT_NEAR(out.wz, 1.0, 1e-12);
  EXPECT_EQ(out.vy, 0);
}

TEST_F(DynamicDriveTest, SlipsAsOftenAsAndAsLongAsItSays) {
  driver.params.set("slip_probability_per_s", 0.5)
      .set("slip_factor", 0.25)
      .set("slip_duration_s", 0.2)
      .set("natural_frequency_radps", 1000)
      .set("damping_ratio", 1);
  driver.step_s = 0.01;
  driver.start();
  constexpr int kSteps = 1'000'000;
  int slipping = 0;
  int slips = 0;
  int length = 0;
  for (int k = 0; k < kSteps; ++k) {
    const Twist2 out = step(velocity_command(1, 0), static_cast<std::uint32_t>(k), 0.01);
    const double left_mps = out.vx - 0.2 * out.wz;
    if (k < 100) continue;  // still speeding up
    if (left_mps < 0.5) {
      ASSERT_NEAR(left_mps, 0.25, 1e-6);
      ++slipping;
      ++length;
    } else {
      ASSERT_NEAR(left_mps, 1.0, 1e-6);
      if (length > 0) {
        ++slips;
        ASSERT_EQ(length, 20) << "step " << k;
      }
      length = 0;
    }
  }
  // A wheel grips for 1 / p = 2.005 s on average (geometric, 0.01 s steps), then slips for 0.2 s:
  // about 4535 slips in 10'000 s, standard deviation about 61.
  const double chance = 1.0 - exp(-0.5 * 0.01);
  const double expected = kSteps / (1.0 / chance + 20.0);
  EXPECT_NEAR(slips, expected, 4 * 61);
  EXPECT_NEAR(slipping, 20.0 * expected, 20 * 4 * 61);
}

TEST_F(DynamicDriveTest, WheelsSlipIndependentlyAndRepeatably) {
  driver.params.set("slip_probability_per_s", 2);
  driver.start();
  std::vector<Twist2> first;
  int turned = 0;
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    first.push_back(step(velocity_command(1, 0), k));
    turned += first.back().wz != 0 ? 1 : 0;
  }
  EXPECT_GT(turned, 1000) << "one wheel alone slips often";
  driver.start();
  for (std::uint32_t k = 0; k < 20'000; ++k) {
    ASSERT_EQ(step(velocity_command(1, 0), k), first[k]) << k;
  }
}

TEST_F(DynamicDriveTest, StandsStillWithoutACommand) {
  driver.start();
  EXPECT_EQ(step({}, 0), Twist2{});
}

TEST(SecondOrderTransition, TwoHalfStepsAreOneStep) {
  const Transition half = second_order_transition(40, 0.3, 0.05);
  const Transition whole = second_order_transition(40, 0.3, 0.1);
  const Transition both = half * half;
  EXPECT_NEAR(both.a, whole.a, 1e-12);
  EXPECT_NEAR(both.b, whole.b, 1e-12);
  EXPECT_NEAR(both.c, whole.c, 1e-10);
  EXPECT_NEAR(both.d, whole.d, 1e-12);
}

}  // namespace
}  // namespace rave
