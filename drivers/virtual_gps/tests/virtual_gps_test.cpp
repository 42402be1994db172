// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"
#include "rave/math/geodesy.hpp"

namespace rave::testing {
namespace {

const GeoFrame kEarth({52.5, 13.4, 0}, 0);

class VirtualGps : public ::testing::Test {
 protected:
  std::vector<double> read(SensorUnderTest& sensor, const Pose2& X_WR) {
    item.X_WR = item.X_WS = X_WR;
    return sensor.sample<double>(world, item);
  }
  /// Where a fix is in the world.
  static Point3 back(const std::vector<double>& fix) {
    return kEarth.world_point({fix.at(0), fix.at(1), 0.5});
  }
  FakeWorld world;
  RobotId robot = world.add_robot({0, 0, 0}, 0.2);
  SampleItem item = looking_from(robot, {});
};

TEST_F(VirtualGps, IsWhereItIs) {
  SensorUnderTest sensor({{"noise_m", 0}, {"multipath_m", 0}});
  ASSERT_TRUE(sensor.configured) << sensor.error();
  // A minute of latitude is about a nautical mile, 1855 m at this place.
  const auto north = read(sensor, {0, 1855, 0});
  EXPECT_NEAR(north.at(0), 52.5 + 1.0 / 60, 2e-5);
  EXPECT_NEAR(north.at(1), 13.4, 1e-9);
  EXPECT_EQ(north.at(2), 0.0);
  const Point3 there = back(read(sensor, {123, -45, 1}));
  EXPECT_NEAR(there.x, 123, 1e-6);
  EXPECT_NEAR(there.y, -45, 1e-6);
}

TEST_F(VirtualGps, TheWorldMayBeTurned) {
  SensorUnderTest sensor({{"noise_m", 0}, {"multipath_m", 0}, {"x_axis_deg", 90}});
  const Point3 there = back(read(sensor, {100, 0, 0}));
  EXPECT_NEAR(there.x, 0, 1e-6);
  EXPECT_NEAR(there.y, 100, 1e-6);
}

TEST_F(VirtualGps, HasNoFixInShadows) {
  SensorUnderTest sensor({{"shadows", 0, {5, 5, 2}}});
  EXPECT_EQ(read(sensor, {5, 6, 0}).size(), 0U);
  EXPECT_EQ(read(sensor, {5, 7.1, 0}).size(), 3U);
  SensorUnderTest wrong({{"shadows", 0, {5, 5}}});
  EXPECT_FALSE(wrong.configured);
  EXPECT_NE(wrong.error().find("`shadows` has 2 numbers; expected three"), std::string::npos);
}

TEST_F(VirtualGps, NoiseIsAsConfigured) {
  SensorUnderTest sensor({{"noise_m", 0.5}, {"multipath_m", 0}});
  Statistics east;
  Statistics north;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    item.sequence = i;
    const auto fix = read(sensor, {10, 20, 0});
    const Point3 there = back(fix);
    east.add(there.x);
    north.add(there.y);
    ASSERT_EQ(fix[2], 0.5);
  }
  east.expect_normal(10, 0.5);
  north.expect_normal(20, 0.5);
}

TEST_F(VirtualGps, TheSlowErrorKeepsItsSpreadAndForgets) {
  SensorUnderTest sensor({{"noise_m", 0}, {"multipath_m", 2}, {"multipath_s", 10}});
  Statistics late;
  double product = 0;
  constexpr int kRuns = 100'000;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    sensor.reset();
    item.seed = seed;
    item.sequence = 0;
    item.elapsed_s = 0;
    const double first = back(read(sensor, {})).x;
    item.sequence = 1;
    item.elapsed_s = 5;
    const double second = back(read(sensor, {})).x;
    late.add(second);
    product += first * second / kRuns;
  }
  late.expect_normal(0, 2);
  // Half of its time later the correlation is exp(-0.5).
  EXPECT_NEAR(product / 4, std::exp(-0.5), 0.02);
}

}  // namespace
}  // namespace rave::testing
