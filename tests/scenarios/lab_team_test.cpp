// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <span>

#include "rave/base/random.hpp"
#include "rave/math/transform.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class LabTeam : public ScenarioTest {
 protected:
  static void drive(sim::Engine& engine, std::uint32_t robot, const request::Drive& drive) {
    sim::WorldInput input;
    input.action = request::Order(drive);
    input.author = {true, "anna"};
    input.robot = RobotId(robot);
    const Status status = engine.order(input);
    EXPECT_TRUE(status) << status.error().text();
  }
  /// How it moves in its own frame if a person drives it so for a second.
  Vec2 way_of(std::string_view name, const request::Drive& asked) {
    const World world = make_world(load("lab-team"));
    if (!world.engine) return {};
    const std::uint32_t robot = robot_named(*world.engine, name);
    const Pose2 from = world.engine->true_pose(RobotId(robot));
    drive(*world.engine, robot, asked);
    world.run_until(1);
    return transform_back(from, world.engine->true_pose(RobotId(robot)).position());
  }
  std::uint64_t hash_of(int threads) {
    auto scenario = load("lab-team");
    scenario.scenario.threads = threads;
    const World world = make_world(scenario);
    if (!world.engine) return 0;
    world.run_until(15);
    return world.engine->hash().value();
  }
};

TEST_F(LabTeam, AllGoTheirWays) {
  const auto outcome = run(load("lab-team"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold) << outcome.summary;
}

TEST_F(LabTeam, ThreadsDoNotMatter) {
  const std::uint64_t alone = hash_of(1);
  EXPECT_NE(alone, 0U);
  EXPECT_EQ(hash_of(3), alone);
}

TEST_F(LabTeam, EachIsDrivenByHand) {
  for (const char* const name : {"tank", "millibot-1", "millibot-4", "car", "omni", "quadrotor"}) {
    EXPECT_GT(way_of(name, {0.2, 0}).x, 0.05) << name;
    const double left_m = way_of(name, {0, 0, 0.3}).y;
    const bool slides = std::string_view(name) == "omni" || std::string_view(name) == "quadrotor";
    if (slides) {
      EXPECT_GT(left_m, 0.15) << name;
    } else {
      EXPECT_NEAR(left_m, 0, 0.02) << name;
    }
  }
}

TEST_F(LabTeam, OnlyTheGearLetsTheCarReverse) {
  const auto pedals = [](double steering, double throttle, double brake, double gear) {
    return request::Drive{0, 0, 0, request::Pedals{steering, throttle, brake, gear}};
  };
  const Vec2 left = way_of("car", pedals(1, 0.5, 0, 1));
  EXPECT_GT(left.x, 0.1);
  EXPECT_GT(left.y, 0.02) << "steering is positive to the left";
  EXPECT_LT(way_of("car", pedals(0, 0.5, 0, -1)).x, -0.1);
  EXPECT_EQ(way_of("car", pedals(0, 1, 0, 0)).x, 0) << "neutral";
  EXPECT_EQ(way_of("car", pedals(0, 1, 1, 1)).x, 0) << "the brake";
}

TEST_F(LabTeam, WhoeverCommandsTheGuardedLeaveNoFenceAndTouchNobody) {
  constexpr double kWide_m = 4.7;
  constexpr double kHigh_m = 3.7;
  const auto catalogue = plugins();
  auto built = runtime::build(load("lab-team"), *catalogue, options());
  ASSERT_TRUE(built) << built.error().text();
  for (sim::RobotType& type : built->spec.types) {
    if (!type.guard) continue;
    type.guard->fence_W = {
        {-kWide_m, -kHigh_m}, {kWide_m, -kHigh_m}, {kWide_m, kHigh_m}, {-kWide_m, kHigh_m}};
  }
  const auto made = sim::Engine::create(std::move(built->spec));
  ASSERT_TRUE(made) << made.error().text();
  sim::Engine& engine = **made;
  // The tank has no guard, and would run into them.
  engine.stop(RobotId(robot_named(engine, "tank")));
  const std::uint32_t guarded[] = {robot_named(engine, "car"), robot_named(engine, "omni")};
  // With this seed a car whose steering is taken for immediate leaves the fence.
  RandomStream random(1, 1, 1, 0);
  std::size_t slowed = 0;
  for (int step = 0; step < 12'000; ++step) {
    for (const std::uint32_t robot : guarded) {
      if (step % 40 != static_cast<int>(robot)) continue;
      request::Drive asked{random.uniform(-2, 2), random.uniform(-3, 3), random.uniform(-2, 2)};
      if (random.bits() % 3 != 0) {
        constexpr double kGears[] = {-1, 1, 1};
        asked.pedals = request::Pedals{random.uniform(-1, 1), random.uniform(0, 1), 0,
                                       kGears[random.bits() % 3]};
      }
      drive(engine, robot, asked);
    }
    ASSERT_TRUE(engine.step());
    for (const sim::Event& event : engine.events()) {
      const bool own = std::ranges::count(guarded, event.robot.value()) > 0;
      if (!own) continue;
      slowed += event.kind == sim::EventKind::kGuardSlowed ? 1 : 0;
      // Benches are no robots: nobody guards them.
      const bool robots = event.kind == sim::EventKind::kContact &&
                          engine.spec().world.is_robot(event.other.value());
      ASSERT_FALSE(robots) << "step " << step << ", robot " << event.robot.value()
                           << " touches body " << event.other.value();
    }
    for (const std::uint32_t robot : guarded) {
      const Pose2 X_WR = engine.true_pose(RobotId(robot));
      for (const world::Shape& shape : engine.spec().world.robots[robot].shapes) {
        const std::span<const Vec2> corners =
            shape.polygon ? shape.vertices() : std::span(&shape.centre, 1);
        for (const Vec2 p_R : corners) {
          const Vec2 p_W = transform(X_WR, p_R);
          ASSERT_LE(std::abs(p_W.x) + shape.radius_m, kWide_m + 2e-3) << "step " << step;
          ASSERT_LE(std::abs(p_W.y) + shape.radius_m, kHigh_m + 2e-3) << "step " << step;
        }
      }
    }
  }
  EXPECT_GT(slowed, 10U);
}

}  // namespace
}  // namespace rave::tests
