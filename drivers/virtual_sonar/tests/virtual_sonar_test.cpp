// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

TEST(VirtualSonar, SamplesItsConeFinelyEnough) {
  const SensorUnderTest sonar({{"cone_deg", 25}, {"resolution_deg", 2}});
  ASSERT_TRUE(sonar.configured) << sonar.error();
  const FanQuery& fan = sonar.declaration.fan;
  EXPECT_EQ(fan.ray_count, 15U);  // 12.5 / 2 makes 7 gaps on either side of the axis
  EXPECT_EQ(fan.rays_per_reading, fan.ray_count);
  EXPECT_NEAR(fan.bearings_rad[0], deg_to_rad(-12.5), 1e-15);
  EXPECT_EQ(fan.bearings_rad[7], 0.0);
  EXPECT_NEAR(fan.bearings_rad[14], deg_to_rad(12.5), 1e-15);
  for (std::uint32_t i = 1; i < fan.ray_count; ++i) {
    EXPECT_LE(fan.bearings_rad[i] - fan.bearings_rad[i - 1], deg_to_rad(2));
  }
  EXPECT_NEAR(sonar.declaration.cone_rad, deg_to_rad(25), 1e-15);
  ASSERT_NE(sonar.declaration.reading_bearings_rad, nullptr);
  EXPECT_EQ(sonar.declaration.reading_bearings_rad[0], 0.0);
}

TEST(VirtualSonar, CoarseResolutionKeepsEdgesAndAxis) {
  const SensorUnderTest sonar({{"cone_deg", 10}, {"resolution_deg", 90}});
  EXPECT_EQ(sonar.declaration.fan.ray_count, 3U);
}

TEST(VirtualSonar, ReadsTheNearestInItsCone) {
  FakeWorld world;
  const RobotId robot = world.add_robot({0, 0, 0}, 0.2);
  world.add_box({5.5, 0, 0}, {0.5, 5});  // a wall, 5 m ahead
  const Vec2 beside = 3.0 * Vec2{cos(deg_to_rad(10)), sin(deg_to_rad(10))};
  const BodyId post = world.add_disc(beside, 0.2);
  const SampleItem item = looking_from(robot, {0, 0, 0});
  const SensorUnderTest sonar({{"cone_deg", 30}, {"resolution_deg", 1}});
  const auto ranges = sonar.ranges(world, item);
  ASSERT_EQ(ranges.size(), 1U);
  EXPECT_NEAR(ranges[0], 2.8, 1e-9);  // a ray goes through the middle of the post

  // The shadow of the post ends 3.82 degrees before its centre: a narrow cone looks past it.
  const SensorUnderTest narrow({{"cone_deg", 12}, {"resolution_deg", 1}});
  EXPECT_NEAR(narrow.ranges(world, item)[0], 5.0, 1e-9);

  // Between two rays the nearest point is missed by less than the README's bound.
  const Vec2 off_ray = 3.0 * Vec2{cos(deg_to_rad(10.5)), sin(deg_to_rad(10.5))};
  world.at(post).X_WB = {off_ray.x, off_ray.y, 0};
  EXPECT_GT(sonar.ranges(world, item)[0], 2.8);
  EXPECT_LT(sonar.ranges(world, item)[0], 2.8 + 0.002);
}

TEST(VirtualSonar, RefusesRangesUpsideDown) {
  const SensorUnderTest sonar({{"range_min_m", 2}, {"range_max_m", 2}});
  EXPECT_FALSE(sonar.configured);
  EXPECT_EQ(sonar.error(), "`range_min_m` is 2 and must be smaller than `range_max_m`, which is 2");
}

}  // namespace
}  // namespace rave::testing
