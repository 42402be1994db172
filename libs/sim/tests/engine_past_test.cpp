// SPDX-License-Identifier: Apache-2.0
#include "rave/math/transform.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

EngineSpec moving_world() {
  EngineSpec spec;
  spec.history = from_seconds(0.5);
  spec.world.obstacles.push_back(box({3.5, 0, 0}, 1, 9));
  RobotType driven = real_type({{"vx", 0.5}});
  driven.sensors.push_back(laser(1, 0, 9));
  driven.sensors.push_back(virtual_sensor<Beacon>("beacon"));
  add_robot(spec, std::move(driven));
  RobotType turning = simulated_type();
  turning.program = program<Drive>({{"v", 0.5}, {"w", 1}});
  add_robot(spec, std::move(turning), {0, 2, 0});
  RobotType watching = simulated_type();
  watching.sensors.push_back(laser(1, 0, 9));
  add_robot(spec, std::move(watching), {-1, 0, 0});
  return spec;
}

constexpr RobotId kReal(0);
constexpr RobotId kTurning(1);
constexpr RobotId kWatching(2);  // stands behind the real one and looks at it

double range_at(Engine& engine, double t_s) {
  float reading = -1;
  const auto header = engine.sample_at(kReal, 1, {from_seconds(t_s).ns}, &reading);
  EXPECT_TRUE(header.has_value()) << (header ? "" : header.error().text());
  if (header) {
    EXPECT_EQ(header->stamp_ns, from_seconds(t_s).ns);
  }
  return double{reading};
}

double seen_x_m(Engine& engine, double t_s) {
  float reading = -1;
  EXPECT_TRUE(engine.sample_at(kWatching, 0, {from_seconds(t_s).ns}, &reading).has_value());
  return double{reading} - 1 + 0.15;
}

TEST(EnginePast, PosesLieOnTheWaysThatWereDriven) {
  const auto engine = make_engine(moving_world());
  run(*engine, 101);  // shows 1.00 s
  for (const double t_s : {0.5, 0.503, 0.7123, 0.99, 0.9999, 1.0}) {
    const auto real = engine->pose_at(kReal, {from_seconds(t_s).ns});
    ASSERT_TRUE(real.has_value()) << t_s;
    // After the newest sample, that of 0.994 s, the pose stays.
    EXPECT_NEAR(real->x, 0.5 * std::min(t_s, 0.994), 1e-9) << t_s;
    const auto turning = engine->pose_at(kTurning, {from_seconds(t_s).ns});
    ASSERT_TRUE(turning.has_value()) << t_s;
    const Pose2 expected = integrate({0, 2, 0}, {0.5, 0, 1}, t_s);
    EXPECT_NEAR(turning->x, expected.x, 1e-5);
    EXPECT_NEAR(turning->y, expected.y, 1e-5);
    EXPECT_NEAR(turning->yaw, expected.yaw, 1e-9);
  }
  EXPECT_EQ(engine->pose_at(kTurning, {1'000'000'000}).value(), engine->snapshot().pose(kTurning));
}

TEST(EnginePast, EndsWhereTheHistoryEnds) {
  const auto engine = make_engine(moving_world());
  EXPECT_FALSE(engine->pose_at(kTurning, {0}).has_value());
  run(*engine, 101);
  for (const RobotId robot : {kReal, kTurning}) {
    const auto later = engine->pose_at(robot, {1'000'000'001});
    ASSERT_FALSE(later.has_value());
    EXPECT_EQ(later.error().text(), "robot `r" + std::to_string(robot.value()) +
                                        "` has no pose at 1.000 s in the history");
  }
  EXPECT_FALSE(engine->pose_at(kTurning, {from_seconds(0.4).ns}).has_value());
  float reading = 0;
  EXPECT_FALSE(engine->sample_at(kReal, 1, {from_seconds(1.1).ns}, &reading).has_value());
  PoseReading pose;
  const auto real = engine->sample_at(kReal, 0, {from_seconds(0.9).ns}, &pose);
  ASSERT_FALSE(real.has_value());
  EXPECT_EQ(real.error().text(), "sensor `mocap` is not virtual");
}

TEST(EnginePast, AVirtualSensorReadsWhatItWouldHaveReadThen) {
  const auto engine = make_engine(moving_world());
  run(*engine, 101);
  for (const double t_s : {0.6, 0.7123, 0.994}) {
    EXPECT_NEAR(range_at(*engine, t_s), 3 - 0.5 * t_s, 1e-6) << t_s;
  }
  PoseReading pose;
  ASSERT_TRUE(engine->sample_at(kReal, 2, {from_seconds(0.8).ns}, &pose).has_value());
  EXPECT_NEAR(pose.x_m, 0.4, 1e-9);
}

TEST(EnginePast, LearnsFromSamplesThatComeLater) {
  const auto engine = make_engine(moving_world());
  run(*engine, 101);
  // Of 1.00 s only the pose of 0.994 s is known; one step later that of 1.008 s is, too.
  EXPECT_NEAR(range_at(*engine, 1.0), 3 - 0.5 * 0.994, 1e-6);
  EXPECT_NEAR(seen_x_m(*engine, 1.0), 0.5 * 0.994, 1e-6);
  run(*engine, 1);
  EXPECT_NEAR(range_at(*engine, 1.0), 2.5, 1e-6);
  EXPECT_NEAR(seen_x_m(*engine, 1.0), 0.5, 1e-6);
}

TEST(EnginePast, IsForgottenInAReset) {
  const auto engine = make_engine(moving_world());
  run(*engine, 101);
  EXPECT_NEAR(range_at(*engine, 0.6), 2.7, 1e-6);
  EXPECT_NEAR(seen_x_m(*engine, 0.6), 0.3, 1e-6);
  ASSERT_TRUE(engine->reset().has_value());
  float reading = 0;
  EXPECT_FALSE(engine->sample_at(kReal, 1, {from_seconds(0.6).ns}, &reading).has_value());
  EXPECT_FALSE(engine->pose_at(kReal, {0}).has_value());
  run(*engine, 61);  // shows 0.60 s; the newest pose is that of 0.595 s
  EXPECT_NEAR(range_at(*engine, 0.6), 3 - 0.5 * 0.595, 1e-6);
  EXPECT_NEAR(seen_x_m(*engine, 0.6), 0.5 * 0.595, 1e-6);
}

TEST(EnginePast, LookingBackChangesNothing) {
  const auto plain = make_engine(moving_world());
  const auto looked = make_engine(moving_world());
  for (int k = 0; k < 60; ++k) {
    run(*plain, 1);
    run(*looked, 1);
    if (k > 20) range_at(*looked, 0.01 * k - 0.1);
  }
  EXPECT_EQ(looked->hash(), plain->hash());
}

}  // namespace
}  // namespace rave::sim::testing
