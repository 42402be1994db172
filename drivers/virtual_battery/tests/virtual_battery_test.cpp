// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

/// One watt-hour, 36 W idle: a per cent each second.
std::vector<Given> small_and(std::vector<Given> more = {}) {
  std::vector<Given> all = {{"capacity_wh", 1},       {"idle_w", 36}, {"drive_w_per_mps", 72},
                            {"turn_w_per_radps", 18}, {"full_v", 12}, {"empty_v", 10},
                            {"resistance_ohm", 0}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class VirtualBattery : public ::testing::Test {
 protected:
  std::vector<double> start(SensorUnderTest& sensor) {
    item = looking_from(robot, {1, 1, 0});
    return sensor.sample<double>(world, item);
  }
  /// A sample some seconds later.
  std::vector<double> later(SensorUnderTest& sensor, double seconds, const Pose2& X_WR) {
    item.elapsed_s = seconds;
    item.X_WR = item.X_WS = X_WR;
    ++item.sequence;
    return sensor.sample<double>(world, item);
  }
  FakeWorld world;
  RobotId robot = world.add_robot({1, 1, 0}, 0.2);
  SampleItem item;
};

TEST_F(VirtualBattery, TimeAndMotionDrainIt) {
  SensorUnderTest sensor(small_and());
  ASSERT_TRUE(sensor.configured) << sensor.error();
  const auto full = start(sensor);
  ASSERT_EQ(full.size(), 6U);
  // 36 W at 12 V; a watt-hour at 11 V on average.
  EXPECT_EQ(std::vector<double>(full.begin(), full.begin() + 3), (std::vector<double>{1, 12, -3}));
  EXPECT_NEAR(full[3], 1 / 11.0, 1e-12);
  EXPECT_NEAR(full[4], 1 / 11.0, 1e-12);
  EXPECT_TRUE(std::isnan(full[5])) << "it does not know its temperature";
  auto now = later(sensor, 10, {1, 1, 0});
  EXPECT_NEAR(now[0], 0.90, 1e-12);
  EXPECT_NEAR(now[1], 11.8, 1e-12);
  // 2 m are 144 J, 4 per cent; a radian is half a one.
  now = later(sensor, 1, {3, 1, 0});
  EXPECT_NEAR(now[0], 0.85, 1e-12);
  now = later(sensor, 1, {3, 1, -1});
  EXPECT_NEAR(now[0], 0.835, 1e-12);
  now = later(sensor, 1000, {3, 1, -1});
  EXPECT_EQ(now[0], 0.0);
  EXPECT_NEAR(now[1], 10, 1e-12);
}

TEST_F(VirtualBattery, VoltageFallsUnderLoad) {
  SensorUnderTest sensor(small_and({{"resistance_ohm", 0.5}, {"charge_start", 0.5}}));
  // 36 W at 11 V are 3.27 A.
  EXPECT_NEAR(start(sensor)[1], 11 - 0.5 * 36 / 11.0, 1e-12);
}

TEST_F(VirtualBattery, ChargersFillIt) {
  SensorUnderTest sensor(small_and({{"charge_start", 0.5}, {"chargers", 0, {5, 5, 1, 72}}}));
  start(sensor);
  later(sensor, 0, {5, 5.5, 0});
  const double before = later(sensor, 0.0, {5, 5.5, 0})[0];
  EXPECT_NEAR(later(sensor, 10, {5, 5.5, 0})[0], before + 0.1, 1e-12);
  EXPECT_EQ(later(sensor, 1000, {5, 5.5, 0})[0], 1.0);
}

TEST_F(VirtualBattery, RefusesWhatCannotBe) {
  SensorUnderTest reversed({{"full_v", 9}});
  EXPECT_FALSE(reversed.configured);
  EXPECT_NE(reversed.error().find("`empty_v` is 10.5 and must be smaller than `full_v`"),
            std::string::npos);
  SensorUnderTest three({{"chargers", 0, {1, 2, 3}}});
  EXPECT_FALSE(three.configured);
  EXPECT_NE(three.error().find("`chargers` has 3 numbers; expected four"), std::string::npos);
}

}  // namespace
}  // namespace rave::testing
