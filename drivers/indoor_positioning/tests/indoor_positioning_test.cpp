// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

constexpr std::uint32_t kSamples = 100000;
constexpr Pose2 kPlace{3, -4, 3.14};

class IndoorPositioning : public ::testing::Test {
 protected:
  std::vector<PoseReading> sample(SensorUnderTest& sensor, const Pose2& X_WR,
                                  std::uint32_t sequence = 0) {
    SampleItem item = looking_from(robot, X_WR);
    item.sequence = sequence;
    return sensor.sample<PoseReading>(world, item);
  }
  FakeWorld world;
  RobotId robot = world.add_robot(kPlace, 0.2);
};

TEST_F(IndoorPositioning, WithoutNoiseGivesThePoseOfTheRobot) {
  SensorUnderTest sensor({{"sigma_xy_m", 0}, {"sigma_yaw_deg", 0}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  SampleItem item = looking_from(robot, kPlace);
  item.X_WS = {9, 9, 9};  // the mounting does not matter
  const auto reading = sensor.sample<PoseReading>(world, item);
  ASSERT_EQ(reading.size(), 1U);
  EXPECT_EQ(reading[0].x_m, kPlace.x);
  EXPECT_EQ(reading[0].y_m, kPlace.y);
  EXPECT_EQ(reading[0].yaw_rad, kPlace.yaw);
  EXPECT_EQ(reading[0].variance_xy_m2, 0.0);
  EXPECT_EQ(reading[0].variance_yaw_rad2, 0.0);
}

TEST_F(IndoorPositioning, NoiseIsAsConfigured) {
  SensorUnderTest sensor({{"sigma_xy_m", 0.05}, {"sigma_yaw_deg", 2}});
  Statistics x;
  Statistics y;
  Statistics yaw;
  Statistics xy;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto reading = sample(sensor, kPlace, i);
    ASSERT_EQ(reading.size(), 1U);
    ASSERT_LE(std::abs(reading[0].yaw_rad), kPi);
    EXPECT_DOUBLE_EQ(reading[0].variance_xy_m2, 0.05 * 0.05);
    EXPECT_DOUBLE_EQ(reading[0].variance_yaw_rad2, deg_to_rad(2) * deg_to_rad(2));
    x.add(reading[0].x_m - kPlace.x);
    y.add(reading[0].y_m - kPlace.y);
    yaw.add(wrap_angle(reading[0].yaw_rad - kPlace.yaw));
    xy.add((reading[0].x_m - kPlace.x) * (reading[0].y_m - kPlace.y) / (0.05 * 0.05));
  }
  x.expect_normal(0, 0.05);
  y.expect_normal(0, 0.05);
  yaw.expect_normal(0, deg_to_rad(2));
  EXPECT_NEAR(xy.mean(), 0, 5 / std::sqrt(kSamples)) << "x and y must be independent";
}

TEST_F(IndoorPositioning, DropsOutAtRandom) {
  SensorUnderTest sensor({{"dropout_probability", 0.2}});
  Statistics lost;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    lost.add(sample(sensor, kPlace, i).empty() ? 1 : 0);
  }
  EXPECT_NEAR(lost.mean(), 0.2, 5 * std::sqrt(0.2 * 0.8 / kSamples));

  SensorUnderTest never({{"dropout_probability", 0}});
  SensorUnderTest always({{"dropout_probability", 1}});
  for (std::uint32_t i = 0; i < 1000; ++i) {
    ASSERT_EQ(sample(never, kPlace, i).size(), 1U);
    ASSERT_EQ(sample(always, kPlace, i).size(), 0U);
  }
}

TEST_F(IndoorPositioning, IsSilentInItsZones) {
  SensorUnderTest sensor({{"dropout_zones_m", 0, {0, 0, 1, 2, -5, -5, -4, -4}}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  EXPECT_TRUE(sample(sensor, {0.5, 1, 0}).empty());
  EXPECT_TRUE(sample(sensor, {1, 2, 0}).empty()) << "the border belongs to the zone";
  EXPECT_EQ(sample(sensor, {1.001, 1, 0}).size(), 1U);
  EXPECT_EQ(sample(sensor, {0.5, 2.001, 0}).size(), 1U);
  EXPECT_EQ(sample(sensor, {0.5, -0.001, 0}).size(), 1U);
  EXPECT_EQ(sample(sensor, {-0.001, 1, 0}).size(), 1U);
  EXPECT_TRUE(sample(sensor, {-4.5, -4.5, 0}).empty()) << "the second zone counts too";
}

TEST_F(IndoorPositioning, ZonesDoNotChangeOtherSamples) {
  SensorUnderTest with({{"dropout_zones_m", 0, {0, 0, 1, 1}}, {"dropout_probability", 0.1}});
  SensorUnderTest without({{"dropout_probability", 0.1}});
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto a = sample(with, kPlace, i);
    const auto b = sample(without, kPlace, i);
    ASSERT_EQ(a.size(), b.size());
    if (!a.empty()) {
      ASSERT_EQ(a[0].x_m, b[0].x_m);
    }
  }
}

TEST_F(IndoorPositioning, RefusesWrongZones) {
  const SensorUnderTest short_list({{"dropout_zones_m", 0, {0, 0, 1}}});
  EXPECT_FALSE(short_list.configured);
  EXPECT_EQ(short_list.error(),
            "`dropout_zones_m` has 3 numbers; each zone takes four: x_min, y_min, x_max, y_max");
  const SensorUnderTest upside_down({{"dropout_zones_m", 0, {0, 0, 1, 1, 3, 0, 2, 1}}});
  EXPECT_FALSE(upside_down.configured);
  EXPECT_EQ(upside_down.error(),
            "zone 2 of `dropout_zones_m` is 3, 0, 2, 1: x_min must be smaller than x_max and "
            "y_min smaller than y_max");
}

}  // namespace
}  // namespace rave::testing
