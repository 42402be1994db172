// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineMixed, RealAndSimulatedRobotsSeeEachOtherAtTheSameInstant) {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({2.5, 0, 0}, 1, 4));
  RobotType driven = real_type({{"vx", 0.1}});
  driven.sensors.push_back(laser());
  driven.sensors.back().X_RS = {0.05, 0, 0};
  const RobotId real = add_robot(spec, std::move(driven));
  // Crosses the real robot's view and looks to its left, where the real one is.
  RobotType passing = simulated_type();
  passing.sensors.push_back(laser());
  passing.sensors.back().X_RS = {0, 0, kPi / 2};
  passing.program = program<Drive>({{"v", 0.5}});
  const RobotId simulated = add_robot(spec, std::move(passing), {1, -1, kPi / 2});
  const auto engine = make_engine(std::move(spec));
  int box_seen = 0;
  int both_seen = 0;
  for (int k = 0; k < 400; ++k) {
    run(*engine, 1);
    const double now_s = 0.01 * k;
    const double real_x_m = 0.1 * 0.007 * std::floor(now_s / 0.007 + 1e-9);
    const double y_m = -1 + 0.5 * now_s;
    const double half_m = std::sqrt(std::max(0.15 * 0.15 - y_m * y_m, 0.0));
    const SensorSample from_real = engine->sensor(real, 1);
    const SensorSample from_simulated = engine->sensor(simulated, 0);
    if (std::abs(y_m) < 0.145) {
      ++both_seen;
      EXPECT_EQ(BodyId(from_real.bodies[0]), engine->snapshot().body_of(simulated));
      EXPECT_NEAR(range(*engine, real, 1), 1 - half_m - real_x_m - 0.05, 1e-3) << now_s;
      EXPECT_EQ(BodyId(from_simulated.bodies[0]), engine->snapshot().body_of(real));
      EXPECT_NEAR(range(*engine, simulated, 0), 1 - half_m - real_x_m, 1e-3) << now_s;
      EXPECT_EQ(from_real.header->stamp_ns, from_simulated.header->stamp_ns);
    } else if (std::abs(y_m) > 0.155) {
      ++box_seen;
      EXPECT_EQ(BodyId(from_real.bodies[0]), BodyId(0));
      EXPECT_NEAR(range(*engine, real, 1), 2 - real_x_m - 0.05, 1e-3) << now_s;
      EXPECT_EQ(BodyId(from_simulated.bodies[0]), BodyId());
    }
  }
  EXPECT_GT(both_seen, 50);
  EXPECT_GT(box_seen, 300);
}

TEST(EngineMixed, ASensorSeesWhatReachesItsHeight) {
  for (const double z_m : {0.1, 0.3}) {
    EngineSpec spec;
    spec.world.obstacles.push_back(box({1.5, 0, 0}, 1, 1, 0.2));
    RobotType type = simulated_type();
    type.sensors.push_back(laser());
    type.sensors.back().z_m = z_m;
    const RobotId robot = add_robot(spec, std::move(type));
    const auto engine = make_engine(std::move(spec));
    run(*engine, 1);
    if (z_m < 0.2) {
      EXPECT_NEAR(range(*engine, robot, 0), 1, 1e-6);
    } else {
      EXPECT_TRUE(std::isinf(range(*engine, robot, 0)));
    }
  }
}

TEST(EngineMixed, ASensorSeesTheLayersItNames) {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({2.5, 0, 0}, 1, 1));
  spec.world.obstacles[0].body.layer = Layer::kMappedReal;
  add_robot(spec, real_type({{"x", 1}}));
  RobotType type = simulated_type();
  for (const LayerMask layers : {kAllLayers, kUnrealLayers, LayerMask{2}}) {
    type.sensors.push_back(laser());
    type.sensors.back().layers = layers;
  }
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1);
  EXPECT_NEAR(range(*engine, robot, 0), 0.85, 1e-6);
  EXPECT_TRUE(std::isinf(range(*engine, robot, 1)));
  EXPECT_NEAR(range(*engine, robot, 2), 2, 1e-6);
}

EngineSpec meeting(bool with_real) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(laser(31, 4, 1));
  type.program = program<Roam>();
  add_robot(spec, std::move(type));
  // Comes from afar, straight at the other.
  if (with_real) add_robot(spec, real_type({{"x", 4}, {"vx", -1}}));
  return spec;
}

TEST(EngineMixed, ARealRobotChangesASimulatedTrackAndNotBeforeTheyMeet) {
  const auto with = make_engine(meeting(true));
  const auto without = make_engine(meeting(false));
  const RobotId robot(0);
  int first_seen = -1;
  int first_changed = -1;
  for (int k = 0; k < 800; ++k) {
    run(*with, 1);
    run(*without, 1);
    for (const std::uint32_t body : with->sensor(robot, 0).bodies) {
      if (body != BodyId::kNone && first_seen < 0) first_seen = k;
    }
    const bool changed = with->true_pose(robot) != without->true_pose(robot);
    if (changed && first_changed < 0) first_changed = k;
  }
  EXPECT_GT(first_seen, 100);
  EXPECT_GE(first_changed, first_seen);
}

TEST(EngineMixed, ASimulatedRobotYieldsAndTheRealOneIsNeverMoved) {
  EngineSpec spec;
  const RobotId simulated = add_robot(spec, simulated_type(), {1, 0.02, 0});
  const RobotId real = add_robot(spec, real_type({{"vx", 0.5}}));
  const auto engine = make_engine(std::move(spec));
  for (int k = 0; k < 400; ++k) {
    run(*engine, 1);
    const double x_m = 0.5 * 0.007 * std::floor(0.01 * k / 0.007 + 1e-9);
    ASSERT_NEAR(engine->snapshot().pose(real).x, x_m, 1e-9);
    ASSERT_EQ(engine->snapshot().pose(real).y, 0);
    const Vec2 apart =
        engine->snapshot().pose(simulated).position() - engine->snapshot().pose(real).position();
    ASSERT_GT(std::sqrt(squared_norm(apart)), 0.3) << k;
  }
  EXPECT_GT(engine->true_pose(simulated).x, 1.01);
}

}  // namespace
}  // namespace rave::sim::testing
