// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

class VirtualBeaconRanges : public ::testing::Test {
 protected:
  void SetUp() override {
    robot = world.add_robot({0, 0, 0}, 0.2);
    world.add_code(world.body_of(robot), 1, 0, 1);
    other = world.add_robot({0, 2, 0}, 0.1);
    world.add_code(world.body_of(other), 2, 0, 1);
    world.add_code(world.add_disc({3, 4}, 0.1), 7, 0, 1);
  }
  std::vector<double> read(SensorUnderTest& sensor, std::uint32_t sequence = 0) {
    SampleItem item = looking_from(robot, {});
    item.sequence = sequence;
    return sensor.sample<double>(world, item);
  }
  FakeWorld world;
  RobotId robot;
  RobotId other;
};

TEST_F(VirtualBeaconRanges, OneForEachCodeInTheirOrder) {
  // Of itself and of codes that nobody carries it hears nothing.
  SensorUnderTest sensor({{"codes", 0, {7, 1, 2, 99}}, {"range_max_m", 6}, {"noise_m", 0}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  EXPECT_EQ(read(sensor), (std::vector<double>{5, kNone, 2, kNone}));
}

TEST_F(VirtualBeaconRanges, HearsNeitherTooFarNorThroughBodies) {
  SensorUnderTest near({{"codes", 0, {7, 2}}, {"range_max_m", 4}, {"noise_m", 0}});
  EXPECT_EQ(read(near), (std::vector<double>{kNone, 2}));
  world.add_disc({0, 1}, 0.1);
  EXPECT_EQ(read(near), (std::vector<double>{kNone, kNone}));
  SensorUnderTest through(
      {{"codes", 0, {7, 2}}, {"range_max_m", 4}, {"noise_m", 0}, {"occlusion", 0}});
  EXPECT_EQ(read(through), (std::vector<double>{kNone, 2}));
}

TEST_F(VirtualBeaconRanges, ErrorsAreAsConfigured) {
  SensorUnderTest sensor({{"codes", 0, {2, 7}},
                          {"range_max_m", 6},
                          {"noise_m", 0.03},
                          {"noise_share", 0.02},
                          {"sound_error", 0.1},
                          {"miss_probability", 0.25}});
  Statistics near;
  double missed = 0;
  constexpr int kSamples = 100'000;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto ranges = read(sensor, i);
    if (ranges[0] == kNone) {
      ++missed;
    } else {
      near.add(ranges[0]);
    }
  }
  near.expect_normal(2.2, 0.05);
  EXPECT_NEAR(missed / kSamples, 0.25, 5 * std::sqrt(0.25 * 0.75 / kSamples));
}

TEST_F(VirtualBeaconRanges, RefusesCodesThatAreNone) {
  SensorUnderTest none;
  EXPECT_FALSE(none.configured);
  EXPECT_NE(none.error().find("`codes` is empty"), std::string::npos);
  SensorUnderTest half({{"codes", 0, {1.5}}});
  EXPECT_FALSE(half.configured);
  EXPECT_NE(half.error().find("`codes` has 1.5; expected whole numbers"), std::string::npos);
}

}  // namespace
}  // namespace rave::testing
