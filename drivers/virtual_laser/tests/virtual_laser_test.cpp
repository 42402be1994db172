// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

std::vector<double> bearings_deg(const SensorUnderTest& laser) {
  std::vector<double> result;
  for (std::uint32_t i = 0; i < laser.declaration.fan.ray_count; ++i) {
    result.push_back(rad_to_deg(laser.declaration.fan.bearings_rad[i]));
  }
  return result;
}

TEST(VirtualLaser, DescribesItself) {
  const SensorUnderTest laser;
  EXPECT_STREQ(laser.info.name, "virtual_laser");
  EXPECT_EQ(laser.info.kind, DriverKind::kVirtualSensor);
  EXPECT_EQ(laser.info.data_kind, static_cast<std::uint32_t>(ReadingKind::kRanges));
}

TEST(VirtualLaser, SpreadsItsRaysFromEdgeToEdge) {
  const SensorUnderTest laser({{"rays", 5}, {"fov_deg", 180}});
  ASSERT_TRUE(laser.configured) << laser.error();
  EXPECT_EQ(laser.declaration.uses_fan, 1U);
  EXPECT_EQ(laser.declaration.fan.rays_per_reading, 1U);
  const std::vector<double> bearings = bearings_deg(laser);
  ASSERT_EQ(bearings.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(bearings[i], -90.0 + 45.0 * static_cast<double>(i), 1e-12);
  }
}

TEST(VirtualLaser, FullRingDoesNotDoubleTheSeam) {
  const SensorUnderTest laser({{"rays", 4}, {"fov_deg", 360}});
  const std::vector<double> bearings = bearings_deg(laser);
  ASSERT_EQ(bearings.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(bearings[i], -180.0 + 90.0 * static_cast<double>(i), 1e-12);
  }
}

TEST(VirtualLaser, SingleRayLooksAhead) {
  const SensorUnderTest laser({{"rays", 1}, {"fov_deg", 90}});
  EXPECT_EQ(bearings_deg(laser), std::vector<double>{0.0});
}

TEST(VirtualLaser, ReadsGeometry) {
  FakeWorld world;
  const RobotId robot = world.add_robot({1, 2, kPi / 2}, 0.2);
  world.add_box({1, 5, 0}, {3, 0.5});  // its near side is 2.5 m ahead of the robot
  world.add_disc({-1, 2}, 0.25);       // 1.75 m to the left
  const SensorUnderTest laser({{"rays", 3}, {"fov_deg", 180}, {"range_max_m", 6}});
  const auto ranges = laser.ranges(world, looking_from(robot, {1, 2, kPi / 2}));
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_EQ(ranges[0], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(ranges[1], 2.5, 1e-12);
  EXPECT_NEAR(ranges[2], 1.75, 1e-12);
}

TEST(VirtualLaser, PassesItsLimitsOn) {
  FakeWorld world;
  const RobotId robot = world.add_robot({0, 0, 0}, 0.2);
  world.add_disc({2, 0}, 0.5);
  const SampleItem item = looking_from(robot, {0, 0, 0});
  const SensorUnderTest coarse({{"rays", 1}, {"range_min_m", 1.75}, {"range_max_m", 4}});
  EXPECT_EQ(coarse.ranges(world, item)[0], 1.75);
  const SensorUnderTest weak({{"rays", 1}, {"range_max_m", 1.4}});
  EXPECT_EQ(weak.ranges(world, item)[0], std::numeric_limits<double>::infinity());
}

TEST(VirtualLaser, RefusesContradictions) {
  const SensorUnderTest upside_down({{"range_min_m", 3}, {"range_max_m", 2}});
  EXPECT_FALSE(upside_down.configured);
  EXPECT_EQ(upside_down.error(),
            "`range_min_m` is 3 and must be smaller than `range_max_m`, which is 2");
  const SensorUnderTest flat({{"rays", 10}, {"fov_deg", 0}});
  EXPECT_FALSE(flat.configured);
  EXPECT_EQ(flat.error(), "`fov_deg` is 0, so all 10 `rays` coincide");
}

}  // namespace
}  // namespace rave::testing
