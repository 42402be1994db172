// SPDX-License-Identifier: Apache-2.0
// Recorded robots, simulated robots and virtual obstacles sense one another, checked against
// geometry that shares nothing with the range engine.
#include <cmath>

#include "rave/math/transform.hpp"
#include "ray_geometry.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class MutualSensing : public ScenarioTest {
 protected:
  /// The distance along a ray to a body, by the reference functions of the mathematics library.
  static double reference(const sim::Engine& engine, std::uint32_t body, Vec2 p_W, double yaw_rad) {
    const auto& world = engine.spec().world;
    const bool robot = body >= world.obstacles.size();
    const Pose2 X_WB = robot ? engine.snapshot().pose(RobotId(
                                   body - static_cast<std::uint32_t>(world.obstacles.size())))
                             : world.obstacles[body].X_WB;
    return ray_to_body(world, body, X_WB, p_W, yaw_rad);
  }

  /// Rays of one fresh scan that met `wanted`, each compared with geometry to a millimetre.
  static int check_scan(const sim::Engine& engine, std::uint32_t robot, std::uint32_t sensor,
                        const std::function<bool(std::uint32_t)>& wanted) {
    const sim::SensorSample sample = engine.sensor(RobotId(robot), sensor);
    if (sample.header->stamp_ns != engine.time().ns || sample.header->sequence == 0) return 0;
    const Pose2 X_WS = compose(engine.snapshot().pose(RobotId(robot)), sample.info->X_RS);
    const auto* ranges = static_cast<const float*>(sample.records);
    int checked = 0;
    for (std::uint32_t i = 0; i < sample.header->count; ++i) {
      const std::uint32_t body = sample.bodies[i];
      if (body == BodyId::kNone || !wanted(body)) continue;
      const double expected =
          reference(engine, body, X_WS.position(), X_WS.yaw + sample.info->bearings_rad[i]);
      EXPECT_NEAR(double{ranges[i]}, expected, 1e-3);
      ++checked;
    }
    return checked;
  }
};

TEST_F(MutualSensing, RecordedLasersReadVirtualThingsToTheMillimetre) {
  auto world = make_world(load("mixed-reality"));
  ASSERT_TRUE(world.engine);
  const sim::Engine& engine = *world.engine;
  const auto obstacles = static_cast<std::uint32_t>(engine.spec().world.obstacles.size());
  const auto is_virtual = [&](std::uint32_t body) {
    return body < obstacles &&
           engine.spec().world.obstacles[body].body.layer == Layer::kVirtualObstacles;
  };
  const auto is_simulated = [&](std::uint32_t body) {
    return body >= obstacles && engine.spec().world.body(body).layer == Layer::kSimulatedRobots;
  };
  int boxes = 0;
  int robots = 0;
  for (int second = 1; second <= 40; ++second) {
    world.run_until(second);
    for (std::uint32_t r = 0; r < 5; ++r) {
      const std::uint32_t laser = sensor_named(engine, r, "laser");
      boxes += check_scan(engine, r, laser, is_virtual);
      robots += check_scan(engine, r, laser, is_simulated);
    }
  }
  EXPECT_GT(boxes, 100) << "rays that met virtual obstacles";
  EXPECT_GT(robots, 100) << "rays that met simulated robots";
}

TEST_F(MutualSensing, RealAndSimulatedSeeEachOtherAtTheSameInstant) {
  auto world = make_world(load("mixed-reality"));
  ASSERT_TRUE(world.engine);
  const sim::Engine& engine = *world.engine;
  const auto obstacles = static_cast<std::uint32_t>(engine.spec().world.obstacles.size());
  const auto sees = [&](std::uint32_t robot, std::uint32_t other) {
    const auto sample = engine.sensor(RobotId(robot), sensor_named(engine, robot, "laser"));
    if (sample.header->stamp_ns != engine.time().ns) return false;
    for (const std::uint32_t body : sample.bodies) {
      if (body == obstacles + other) return true;
    }
    return false;
  };
  int mutual = 0;
  for (int tenth = 1; tenth <= 600 && mutual == 0; ++tenth) {
    world.run_until(tenth * 0.1);
    for (std::uint32_t real = 0; real < 5; ++real) {
      for (std::uint32_t other = 5; other < engine.spec().robots.size(); ++other) {
        if (sees(real, other) && sees(other, real)) ++mutual;
      }
    }
  }
  EXPECT_GT(mutual, 0);
}

/// Moving the recorded robots a kilometre away takes them out of the world without changing the
/// identity of anybody else.
TEST_F(MutualSensing, RecordedRobotsChangeSimulatedTracksAndNotBeforeTheyAreMet) {
  const auto scenario = load("mixed-reality");
  auto alone = scenario;
  for (config::RobotGroup& group : alone.groups) {
    if (group.robot.pose_from) group.robot.source_frame.x_m = 1000;
  }
  auto with = make_world(scenario);
  auto without = make_world(alone);
  ASSERT_TRUE(with.engine && without.engine);
  const auto obstacles = static_cast<std::uint32_t>(with.engine->spec().world.obstacles.size());
  const std::size_t count = with.engine->spec().robots.size();
  std::vector<bool> met(count, false);
  met[robot_named(*with.engine, "hunter")] = true;  // it senses its prey at any distance
  int changed = 0;
  for (int tenth = 0; tenth <= 200; ++tenth) {
    with.run_until(tenth * 0.1);
    without.run_until(tenth * 0.1);
    for (std::uint32_t r = 5; r < count; ++r) {
      const bool same =
          with.engine->snapshot().pose(RobotId(r)) == without.engine->snapshot().pose(RobotId(r));
      EXPECT_TRUE(same || met[r]) << with.engine->spec().robots[r].name << " changed at "
                                  << tenth * 0.1 << " s without having met anybody";
      if (!same) ++changed;
      const auto sample = with.engine->sensor(RobotId(r), sensor_named(*with.engine, r, "laser"));
      for (const std::uint32_t body : sample.bodies) {
        if (body == BodyId::kNone || body < obstacles) continue;
        // Real robots, or simulated ones that were themselves led astray.
        if (body < obstacles + 5 || met[body - obstacles]) met[r] = true;
      }
    }
  }
  EXPECT_GT(changed, 0) << "the recorded robots made no difference";
}

}  // namespace
}  // namespace rave::tests
