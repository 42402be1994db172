// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"
#include "rave/math/transform.hpp"

namespace rave::testing {
namespace {

constexpr std::size_t kRate = 6;
constexpr std::size_t kAccelX = 7;
constexpr std::size_t kAccelY = 8;

std::vector<Given> perfect_but(std::vector<Given> more = {}) {
  std::vector<Given> all;
  for (const char* const name : {"gyro_noise_radps", "gyro_bias_radps", "gyro_walk_radps",
                                 "accel_noise_mps2", "accel_bias_mps2", "accel_walk_mps2"}) {
    all.push_back({name, 0});
  }
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class VirtualImu : public ::testing::Test {
 protected:
  void start(SensorUnderTest& sensor, const Twist2& v_W, std::uint64_t seed = 42) {
    sensor.reset();
    world.at(robot).velocity_W = v_W;
    item = looking_from(robot, {1, 2, kPi / 2});
    item.seed = seed;
    values = sensor.sample<double>(world, item);
    item.elapsed_s = 0.1;
  }
  void go_on(SensorUnderTest& sensor, const Twist2& v_W, double turn_rad) {
    world.at(robot).velocity_W = v_W;
    item.X_WR.yaw += turn_rad;
    item.X_WS = compose(item.X_WR, X_RS);
    ++item.sequence;
    values = sensor.sample<double>(world, item);
  }
  FakeWorld world;
  RobotId robot = world.add_robot({0, 0, 0}, 0.2);
  Pose2 X_RS;
  SampleItem item;
  std::vector<double> values;
};

TEST_F(VirtualImu, MeasuresInItsOwnFrame) {
  SensorUnderTest sensor(perfect_but());
  ASSERT_TRUE(sensor.configured) << sensor.error();
  start(sensor, {});
  ASSERT_EQ(values.size(), 10U);
  EXPECT_TRUE(std::isnan(values[0])) << "it does not know its orientation";
  EXPECT_EQ(std::vector<double>(values.begin() + 4, values.end()),
            (std::vector<double>{0, 0, 0, 0, 0, 9.80665}));
  // Faster along y of the world, which is ahead; then to the west, which is left.
  go_on(sensor, {0, 0.2, 0}, 0);
  EXPECT_NEAR(values[kAccelX], 2, 1e-12);
  EXPECT_NEAR(values[kAccelY], 0, 1e-12);
  go_on(sensor, {-0.1, 0.2, 0}, 0);
  EXPECT_NEAR(values[kAccelX], 0, 1e-12);
  EXPECT_NEAR(values[kAccelY], 1, 1e-12);
  go_on(sensor, {-0.1, 0.2, 0}, 0.05);
  EXPECT_NEAR(values[kRate], 0.5, 1e-12);
}

TEST_F(VirtualImu, FeelsTheTurnAwayFromTheCentre) {
  SensorUnderTest sensor(perfect_but());
  X_RS = {0.5, 0, 0};
  start(sensor, {});
  go_on(sensor, {}, 0);
  // Begins to turn with 1 rad/s: the point half a metre ahead goes to the left with 0.5 m/s.
  go_on(sensor, {0, 0, 1}, 0);
  EXPECT_NEAR(values[kAccelX], 0, 1e-12);
  EXPECT_NEAR(values[kAccelY], 5, 1e-12);
}

TEST_F(VirtualImu, ShowsNoMoreThanItsRange) {
  SensorUnderTest sensor(perfect_but({{"gyro_max_radps", 2}, {"accel_max_mps2", 3}}));
  start(sensor, {});
  go_on(sensor, {0, -9, 0}, 1);
  EXPECT_EQ(values[kAccelX], -3);
  EXPECT_EQ(values[kRate], 2);
}

TEST_F(VirtualImu, NoiseAndBiasAreAsConfigured) {
  SensorUnderTest sensor(perfect_but({{"gyro_noise_radps", 0.03}, {"accel_bias_mps2", 0.4}}));
  Statistics gyro;
  Statistics bias;
  for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
    start(sensor, {}, seed);
    gyro.add(values[kRate]);
    bias.add(values[kAccelY]);
    if (seed % 1000 != 0) continue;
    const double first = values[kAccelY];
    go_on(sensor, {}, 0);
    EXPECT_EQ(values[kAccelY], first) << "a bias without a walk stays";
  }
  gyro.expect_normal(0, 0.03);
  bias.expect_normal(0, 0.4);
}

TEST_F(VirtualImu, BiasWalksWithTheRootOfTime) {
  SensorUnderTest sensor(perfect_but({{"gyro_walk_radps", 0.02}}));
  Statistics after;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    start(sensor, {}, seed);
    for (int i = 0; i < 10; ++i) go_on(sensor, {}, 0);
    after.add(values[kRate]);
  }
  // Ten samples of 0.1 s are one second.
  after.expect_normal(0, 0.02);
}

}  // namespace
}  // namespace rave::testing
