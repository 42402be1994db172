// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"
#include "rave/math/transform.hpp"

namespace rave::testing {
namespace {

/// 1000 ticks per metre.
const std::vector<Given> kPlain = {{"wheel_radius_m", 1 / (2 * kPi)}, {"ticks_per_turn", 1000}};

std::vector<Given> plain_and(Given more) {
  std::vector<Given> all = kPlain;
  all.push_back(std::move(more));
  return all;
}

/// A robot that drives, and its counters.
class VirtualWheelEncoders : public ::testing::Test {
 protected:
  void SetUp() override { robot = world.add_robot({0, 0, 0}, 0.2); }

  void start(SensorUnderTest& sensor, std::uint64_t seed = 42) {
    sensor.reset();
    pose = {3, 1, 2};
    item = looking_from(robot, pose);
    item.seed = seed;
    ticks = sensor.sample<double>(world, item);
  }
  /// Drives a second with the body twist `v_WR_R`, in one sample.
  void drive(SensorUnderTest& sensor, const Twist2& v_WR_R) {
    pose = integrate(pose, v_WR_R, 1);
    item.X_WR = item.X_WS = pose;
    ++item.sequence;
    ticks = sensor.sample<double>(world, item);
  }

  FakeWorld world;
  RobotId robot;
  Pose2 pose;
  SampleItem item;
  std::vector<double> ticks;
};

TEST_F(VirtualWheelEncoders, CountWholeTicksOfBothWheels) {
  SensorUnderTest sensor(kPlain);
  ASSERT_TRUE(sensor.configured) << sensor.error();
  start(sensor);
  EXPECT_EQ(ticks, (std::vector<double>{0, 0}));
  drive(sensor, {0.1004, 0, 0});
  EXPECT_EQ(ticks, (std::vector<double>{100, 100}));
  // The rest of a tick is kept.
  drive(sensor, {0.0007, 0, 0});
  EXPECT_EQ(ticks, (std::vector<double>{101, 101}));
  // A radian to the left with wheels 0.25 m apart: 125 ticks less and more.
  drive(sensor, {0, 0, 1});
  EXPECT_EQ(ticks, (std::vector<double>{-24, 226}));
  sensor.reset();
  start(sensor);
  EXPECT_EQ(ticks, (std::vector<double>{0, 0}));
}

TEST_F(VirtualWheelEncoders, CountersStartAgainWhenTheyAreFull) {
  SensorUnderTest sensor(plain_and({"counter_bits", 8}));
  start(sensor);
  drive(sensor, {0.3005, 0, 0});
  EXPECT_EQ(ticks, (std::vector<double>{44, 44}));
  drive(sensor, {-0.4, 0, 0});
  EXPECT_EQ(ticks, (std::vector<double>{156, 156}));
}

TEST_F(VirtualWheelEncoders, ALargerWheelCountsLess) {
  SensorUnderTest sensor(plain_and({"wheel_scale_left", 0.5}));
  start(sensor);
  drive(sensor, {0.2001, 0, 0});
  EXPECT_EQ(ticks, (std::vector<double>{100, 200}));
}

TEST_F(VirtualWheelEncoders, NoiseGrowsWithTheRootOfTheWay) {
  SensorUnderTest sensor(plain_and({"noise_per_metre_m", 0.1}));
  Statistics left;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    start(sensor, seed);
    drive(sensor, {4, 0, 0});
    left.add(ticks[0]);
  }
  // 0.1 m * sqrt(4) = 200 ticks; whole ticks are half a one less on average.
  left.expect_normal(3999.5, 200);
}

}  // namespace
}  // namespace rave::testing
