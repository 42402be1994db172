// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

class NeighbourVelocity : public ::testing::Test {
 protected:
  std::vector<std::uint32_t> ids(SensorUnderTest& sensor) {
    std::vector<std::uint32_t> result;
    const SampleItem item = looking_from(robot, {0, 0, 0});
    for (const auto& reading : sensor.sample<NeighbourReading>(world, item)) {
      result.push_back(reading.robot);
    }
    return result;
  }

  FakeWorld world;
  RobotId robot = world.add_robot({0, 0, 0}, 0.2);
};

using Ids = std::vector<std::uint32_t>;

TEST_F(NeighbourVelocity, MeasuresInTheSensorFrame) {
  const RobotId other = world.add_robot({4, 6, 1.3}, 0.2);
  world.at(other).velocity_W = {0.3, -0.4, 5.0};
  SensorUnderTest sensor({{"range_m", 10}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  SampleItem item = looking_from(robot, {0, 0, 0});
  item.X_WS = {1, 2, kPi / 2};  // x of the sensor is y of the world, y is -x
  const auto readings = sensor.sample<NeighbourReading>(world, item);
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].robot, other.value());
  EXPECT_NEAR(readings[0].range_m, 5.0, 1e-6);
  EXPECT_NEAR(readings[0].bearing_rad, atan2(4, 3) - kPi / 2, 1e-6);
  EXPECT_NEAR(readings[0].vx_mps, -0.4, 1e-6);
  EXPECT_NEAR(readings[0].vy_mps, -0.3, 1e-6);
}

TEST_F(NeighbourVelocity, RangeCapacityAndSelf) {
  world.add_robot({1, 0, 0}, 0.2);
  world.add_robot({0, 2.001, 0}, 0.2);
  world.add_robot({0, -1.999, 0}, 0.2);
  world.add_robot({-1, 0, 0}, 0.2);
  SensorUnderTest sensor({{"range_m", 2}});
  EXPECT_EQ(ids(sensor), (Ids{1, 3, 4}));
  SensorUnderTest small({{"range_m", 2}, {"max_neighbours", 2}});
  EXPECT_EQ(ids(small), (Ids{1, 3}));
}

TEST_F(NeighbourVelocity, CrowdsLargerThanTheCapacityAreCut) {
  for (int i = 0; i < 1200; ++i) world.add_robot({0.001 * i, 1, 0}, 0.2);
  SensorUnderTest sensor({{"max_neighbours", 1024}});
  // 1024 candidates, of which the sensor's own robot is one.
  EXPECT_EQ(ids(sensor).size(), 1023U);
  EXPECT_EQ(ids(sensor).back(), 1023U);
}

TEST_F(NeighbourVelocity, LayersAreRespected) {
  world.add_robot({1, 0, 0}, 0.2, Layer::kRealRobots);
  world.add_robot({0, 1, 0}, 0.2, Layer::kSimulatedRobots);
  SensorUnderTest unreal({}, kUnrealLayers);
  EXPECT_EQ(ids(unreal), (Ids{2}));
  SensorUnderTest real({}, static_cast<LayerMask>(Layer::kRealRobots));
  EXPECT_EQ(ids(real), (Ids{1}));
}

TEST_F(NeighbourVelocity, LineOfSightCountsWhenAskedFor) {
  world.add_robot({2, 0, 0}, 0.2);
  world.add_robot({0, 2, 0}, 0.2);
  world.add_robot({4, 0, 0}, 0.2);  // behind the first
  world.add_box({0, 1, 0}, {0.3, 0.1});
  SensorUnderTest through;
  EXPECT_EQ(ids(through), (Ids{1, 2, 3}));
  SensorUnderTest sees({{"needs_line_of_sight", 1}});
  EXPECT_EQ(ids(sees), (Ids{1}));
}

TEST_F(NeighbourVelocity, NoiseIsAsConfigured) {
  const RobotId other = world.add_robot({1, 0, 0}, 0.2);
  world.at(other).velocity_W = {0.5, 0.25, 0};
  SensorUnderTest sensor({{"sigma_velocity_mps", 0.05}});
  Statistics vx;
  Statistics vy;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    SampleItem item = looking_from(robot, {0, 0, 0});
    item.sequence = i;
    const auto readings = sensor.sample<NeighbourReading>(world, item);
    ASSERT_EQ(readings.size(), 1U);
    ASSERT_EQ(readings[0].range_m, 1.0F) << "only velocities are noisy";
    vx.add(static_cast<double>(readings[0].vx_mps));
    vy.add(static_cast<double>(readings[0].vy_mps));
  }
  vx.expect_normal(0.5, 0.05);
  vy.expect_normal(0.25, 0.05);
}

}  // namespace
}  // namespace rave::testing
