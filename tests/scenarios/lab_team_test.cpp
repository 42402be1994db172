// SPDX-License-Identifier: Apache-2.0
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

}  // namespace
}  // namespace rave::tests
