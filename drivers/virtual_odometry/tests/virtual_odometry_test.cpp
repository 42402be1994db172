// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"
#include "rave/math/transform.hpp"

namespace rave::testing {
namespace {

constexpr double kStep_s = 0.05;

/// A robot that drives, and its odometry sampled along the way.
class VirtualOdometry : public ::testing::Test {
 protected:
  void SetUp() override { robot = world.add_robot({0, 0, 0}, 0.2); }

  /// Starts a new run at `X_WR`.
  void start(SensorUnderTest& sensor, const Pose2& X_WR, std::uint64_t seed = 42) {
    sensor.reset();
    pose = X_WR;
    item = looking_from(robot, X_WR);
    item.seed = seed;
    reading = sensor.sample<OdometryReading>(world, item).at(0);
    item.elapsed_s = kStep_s;
  }
  /// Drives `steps` samples on with the body twist `v_WR_R`.
  void drive(SensorUnderTest& sensor, const Twist2& v_WR_R, int steps) {
    for (int i = 0; i < steps; ++i) {
      pose = integrate(pose, v_WR_R, kStep_s);
      item.X_WR = item.X_WS = pose;
      ++item.sequence;
      reading = sensor.sample<OdometryReading>(world, item).at(0);
    }
  }
  void expect_pose(const Pose2& expected, double tolerance) const {
    EXPECT_NEAR(reading.x_m, expected.x, tolerance);
    EXPECT_NEAR(reading.y_m, expected.y, tolerance);
    EXPECT_NEAR(wrap_angle(reading.yaw_rad - expected.yaw), 0, tolerance);
  }

  FakeWorld world;
  RobotId robot;
  Pose2 pose;
  SampleItem item;
  OdometryReading reading;
};

TEST_F(VirtualOdometry, StartsAtZeroWhereverTheRobotIs) {
  SensorUnderTest sensor({{"noise_per_metre_m", 0.5}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  start(sensor, {7, -3, 2});
  expect_pose({0, 0, 0}, 0);
  EXPECT_EQ(reading.v_mps, 0.0);
  EXPECT_EQ(reading.w_radps, 0.0);
  EXPECT_EQ(reading.variance_xy_m2, 0.0);
  EXPECT_EQ(reading.variance_yaw_rad2, 0.0);
}

TEST_F(VirtualOdometry, WithoutErrorsIsTheTruth) {
  SensorUnderTest sensor;
  const Pose2 X_WO{7, -3, 2};
  start(sensor, X_WO);
  for (const Twist2& twist : {Twist2{0.5, 0, 0}, Twist2{0.3, 0, 0.8}, Twist2{0, 0, -2.5},
                              Twist2{-0.4, 0, -0.3}, Twist2{0, 0, 0}}) {
    drive(sensor, twist, 100);
    expect_pose(compose(inverse(X_WO), pose), 1e-11);
    EXPECT_NEAR(reading.v_mps, twist.vx, 1e-11);
    EXPECT_NEAR(reading.w_radps, twist.wz, 1e-11);
  }
  EXPECT_EQ(reading.variance_xy_m2, 0.0);
  sensor.reset();
  start(sensor, {1, 1, 1});
  expect_pose({0, 0, 0}, 0);
}

TEST_F(VirtualOdometry, SidewaysMotionTurnsNoWheel) {
  SensorUnderTest sensor;
  start(sensor, {0, 0, 0});
  drive(sensor, {0, 0.5, 0}, 50);
  expect_pose({0, 0, 0}, 1e-12);
}

TEST_F(VirtualOdometry, UnequalWheelsBendAStraightLine) {
  // Straight over 4 m, the right wheel counts 1 % too much: 4.02 m of an arc that turns by
  // 0.04 m / 0.25 m = 0.16 rad.
  SensorUnderTest sensor({{"wheel_separation_m", 0.25}, {"wheel_scale_right", 1.01}});
  start(sensor, {0, 0, 0});
  drive(sensor, {0.5, 0, 0}, 160);
  const double radius_m = 4.02 / 0.16;
  expect_pose({radius_m * sin(0.16), radius_m * (1 - cos(0.16)), 0.16}, 1e-10);
  EXPECT_NEAR(reading.v_mps, 0.5025, 1e-12);
  EXPECT_NEAR(reading.w_radps, 0.005 / 0.25, 1e-12);
}

TEST_F(VirtualOdometry, BothScalesStretchLengthAndTurn) {
  SensorUnderTest sensor({{"wheel_scale_left", 0.98}, {"wheel_scale_right", 0.98}});
  start(sensor, {0, 0, 0});
  drive(sensor, {0, 0, 1}, 40);  // 2 rad on the spot
  expect_pose({0, 0, 1.96}, 1e-11);
  start(sensor, {0, 0, 0});
  drive(sensor, {0.5, 0, 0}, 40);
  expect_pose({0.98, 0, 0}, 1e-11);
}

TEST_F(VirtualOdometry, NoiseOfOneSampleIsAsConfigured) {
  SensorUnderTest sensor({{"noise_per_metre_m", 0.1}, {"wheel_separation_m", 0.4}});
  // 0.25 m straight on in one sample: each wheel has sigma = 0.1 * sqrt(0.25) = 0.05 m.
  Statistics turn;
  Statistics length;
  for (std::uint64_t seed = 0; seed < 100000; ++seed) {
    start(sensor, {0, 0, 0}, seed);
    drive(sensor, {5, 0, 0}, 1);
    turn.add(reading.w_radps * kStep_s);
    length.add(reading.v_mps * kStep_s);
  }
  turn.expect_normal(0, std::sqrt(2) * 0.05 / 0.4);
  length.expect_normal(0.25, 0.05 / std::sqrt(2));
  EXPECT_NEAR(reading.variance_yaw_rad2, 2 * 0.05 * 0.05 / (0.4 * 0.4), 1e-12);
}

TEST_F(VirtualOdometry, VariancesTellTheTruth) {
  SensorUnderTest sensor({{"noise_per_metre_m", 0.005}});
  Statistics x;
  Statistics y;
  Statistics yaw;
  Statistics told_xy;
  double last_variance = 0;
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    start(sensor, {0, 0, 0}, seed);
    drive(sensor, {0.5, 0, 0}, 10);
    last_variance = reading.variance_xy_m2;
    drive(sensor, {0.5, 0, 0.6}, 30);
    EXPECT_GT(reading.variance_xy_m2, last_variance);
    x.add(reading.x_m - pose.x);
    y.add(reading.y_m - pose.y);
    yaw.add(wrap_angle(reading.yaw_rad - pose.yaw));
    told_xy.add(reading.variance_xy_m2);
  }
  // The covariance is linearised about the pose as measured: allow one per cent beside chance.
  const double chance = 5 * std::sqrt(2.0 / 20000);
  EXPECT_NEAR(0.5 * (x.variance() + y.variance()) / told_xy.mean(), 1, chance + 0.01);
  EXPECT_NEAR(yaw.variance() / reading.variance_yaw_rad2, 1, chance + 0.01);
}

TEST_F(VirtualOdometry, SameSeedSameDrift) {
  SensorUnderTest sensor({{"noise_per_metre_m", 0.05}});
  start(sensor, {0, 0, 0}, 7);
  drive(sensor, {0.5, 0, 0.3}, 50);
  const OdometryReading first = reading;
  start(sensor, {0, 0, 0}, 7);
  drive(sensor, {0.5, 0, 0.3}, 50);
  EXPECT_EQ(reading.x_m, first.x_m);
  EXPECT_EQ(reading.yaw_rad, first.yaw_rad);
  start(sensor, {0, 0, 0}, 8);
  drive(sensor, {0.5, 0, 0.3}, 50);
  EXPECT_NE(reading.x_m, first.x_m);
}

}  // namespace
}  // namespace rave::testing
