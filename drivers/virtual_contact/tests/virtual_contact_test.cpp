// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

TEST(VirtualContact, TellsWhereInTheBodyFrame) {
  FakeWorld world;
  const RobotId robot = world.add_robot({3, 4, 1.0}, 0.2);
  SensorUnderTest contact;
  ASSERT_TRUE(contact.configured) << contact.error();
  SampleItem item = looking_from(robot, {3, 4, 1.0});
  item.X_WS.yaw = 2.5;  // the mounting does not matter

  auto reading = contact.sample<ContactReading>(world, item);
  ASSERT_EQ(reading.size(), 1U);
  EXPECT_EQ(reading[0].touching, 0U);
  EXPECT_EQ(reading[0].bearing_rad, 0.0F);

  world.at(robot).touch = {true, {cos(0.4), sin(0.4)}};
  reading = contact.sample<ContactReading>(world, item);
  ASSERT_EQ(reading.size(), 1U);
  EXPECT_EQ(reading[0].touching, 1U);
  EXPECT_NEAR(reading[0].bearing_rad, -0.6, 1e-6);

  world.at(robot).touch = {true, {cos(1.0 + 3.0), sin(1.0 + 3.0)}};
  EXPECT_NEAR(contact.sample<ContactReading>(world, item)[0].bearing_rad, 3.0, 1e-6);
}

}  // namespace
}  // namespace rave::testing
