// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

TEST(VirtualInfrared, ReadsOneShortBeam) {
  FakeWorld world;
  const RobotId robot = world.add_robot({0, 0, 0}, 0.2);
  const BodyId wall = world.add_box({0.9, 0, 0}, {0.4, 0.01});
  const SampleItem item = looking_from(robot, {0, 0, 0});
  const SensorUnderTest infrared;
  ASSERT_TRUE(infrared.configured) << infrared.error();
  ASSERT_EQ(infrared.ranges(world, item).size(), 1U);
  EXPECT_NEAR(infrared.ranges(world, item)[0], 0.5, 1e-12);

  world.at(wall).X_WB = {0.45, 0, 0};  // 0.05 m away: nearer than it can tell
  EXPECT_EQ(infrared.ranges(world, item)[0], 0.1);
  world.at(wall).X_WB = {1.21, 0, 0};  // 0.81 m away: too far
  EXPECT_EQ(infrared.ranges(world, item)[0], std::numeric_limits<double>::infinity());
  world.at(wall).X_WB = {0.9, 0.02, 0};  // beside the beam
  EXPECT_EQ(infrared.ranges(world, item)[0], std::numeric_limits<double>::infinity());
}

TEST(VirtualInfrared, RefusesRangesUpsideDown) {
  const SensorUnderTest infrared({{"range_min_m", 0.9}});
  EXPECT_FALSE(infrared.configured);
  EXPECT_EQ(infrared.error(),
            "`range_min_m` is 0.9 and must be smaller than `range_max_m`, which is 0.8");
}

}  // namespace
}  // namespace rave::testing
