// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

class VirtualCompass : public ::testing::Test {
 protected:
  std::vector<double> read(SensorUnderTest& sensor, const Pose2& X_WR, std::uint32_t sequence = 0) {
    SampleItem item = looking_from(robot, X_WR);
    item.sequence = sequence;
    return sensor.sample<double>(world, item);
  }
  FakeWorld world;
  RobotId robot = world.add_robot({0, 0, 0}, 0.2);
};

TEST_F(VirtualCompass, HeadsFromNorthCounterClockwise) {
  SensorUnderTest sensor({{"noise_share", 0}, {"north_deg", 30}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  for (const double yaw_rad : {0.0, 1.0, -2.5}) {
    const auto values = read(sensor, {4, 5, yaw_rad});
    EXPECT_NEAR(values[0], wrap_angle(yaw_rad - deg_to_rad(30)), 1e-12);
    EXPECT_NEAR(values[1], 1, 1e-12);
  }
}

TEST_F(VirtualCompass, DisturbedRegionsAddTheirField) {
  // North is y; in the middle of the region a field of the same strength points along x.
  SensorUnderTest sensor({{"noise_share", 0}, {"disturbed", 0, {2, 0, 1, 1, 0}}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  const auto middle = read(sensor, {2, 0, 0});
  EXPECT_NEAR(middle[0], deg_to_rad(-45), 1e-12);
  EXPECT_NEAR(middle[1], std::sqrt(2), 1e-12);
  EXPECT_NEAR(read(sensor, {2, 0.5, 0})[0], -std::atan2(1, 0.5), 1e-12);
  EXPECT_NEAR(read(sensor, {2, 1, 0})[0], deg_to_rad(-90), 1e-12);
}

TEST_F(VirtualCompass, HardIronTurnsWithTheRobot) {
  SensorUnderTest sensor({{"noise_share", 0}, {"hard_iron_x", 0.5}, {"north_deg", 0}});
  EXPECT_NEAR(read(sensor, {0, 0, 0})[0], 0, 1e-12);
  EXPECT_NEAR(read(sensor, {0, 0, 0})[1], 1.5, 1e-12);
  EXPECT_NEAR(read(sensor, {0, 0, kPi / 2})[0], std::atan2(1, 0.5), 1e-12);
}

TEST_F(VirtualCompass, NoiseOfTheHeadingIsAsConfigured) {
  SensorUnderTest sensor({{"noise_share", 0.01}});
  Statistics heading;
  for (std::uint32_t i = 0; i < 100'000; ++i) heading.add(read(sensor, {0, 0, 2}, i)[0]);
  heading.expect_normal(2 - kPi / 2, 0.01);
}

TEST_F(VirtualCompass, RefusesRegionsThatAreNone) {
  SensorUnderTest four({{"disturbed", 0, {1, 2, 3, 4}}});
  EXPECT_FALSE(four.configured);
  EXPECT_NE(four.error().find("`disturbed` has 4 numbers; expected five"), std::string::npos);
  SensorUnderTest flat({{"disturbed", 0, {1, 2, 0, 4, 0}}});
  EXPECT_FALSE(flat.configured);
  EXPECT_NE(flat.error().find("the radius of a region is 0"), std::string::npos);
}

}  // namespace
}  // namespace rave::testing
