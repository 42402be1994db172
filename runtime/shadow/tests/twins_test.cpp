// SPDX-License-Identifier: Apache-2.0
#include "../src/obstacle_order.hpp"
#include "rave/assemble_testing/host_fixture.hpp"

namespace rave::runtime::testing {
namespace {

std::string robot(const std::string& entry, const std::string& changes = {}) {
  return scenario_text(
      "  - {name: anna, file: ../robots/wanderer.yaml, pose: {x_m: 0, y_m: 0}" + entry + "}\n",
      changes);
}

constexpr const char* kTwin = ", twin: ../robots/wanderer.yaml";

TEST(Twins, BecomeTypesOfTheirOwn) {
  Host host;
  const auto built =
      host.build_text(robot(std::string(kTwin) + ", hand_over: {within_m: 0.5, within_deg: 90}",
                            "changes:\n  - {at_s: 0.5, robot: anna, hand_over: twin}\n"
                            "  - {at_s: 0.2, robot: anna, hand_over: first}\n"));
  ASSERT_TRUE(built) << built.error().text();
  EXPECT_EQ(built->spec.types.size(), 2U);
  EXPECT_EQ(built->spec.robots[0].twin, 1U);
  EXPECT_EQ(built->spec.robots[0].hand_over.within_m, 0.5);
  EXPECT_NEAR(built->spec.robots[0].hand_over.within_rad, 1.5707963, 1e-6);
  const auto& hand_overs = built->spec.hand_overs;
  ASSERT_EQ(hand_overs.size(), 2U);
  EXPECT_EQ(hand_overs[0].step, 20U);
  EXPECT_EQ(hand_overs[0].to, sim::DriverSet::kFirst);
  EXPECT_EQ(hand_overs[1].to, sim::DriverSet::kTwin);
}

TEST(Twins, SurviveTheExpandedScenario) {
  Host host;
  const auto scenario =
      host.expand(robot(kTwin, "changes:\n  - {at_s: 0.5, robot: anna, hand_over: twin}\n"));
  ASSERT_TRUE(scenario) << scenario.error().text();
  ASSERT_TRUE(scenario->groups[0].twin);
  const auto again = host.expand(config::write_expanded(*scenario));
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(again->groups, scenario->groups);
  EXPECT_EQ(again->scenario.changes, scenario->scenario.changes);
}

TEST(Twins, ShadowsSeeObstaclesGoBeforeOthersOfTheirNameCome) {
  using Kind = sim::EventKind;
  const auto event = [](Kind kind, std::uint32_t obstacle) {
    return sim::Event{7, RobotId(), kind, BodyId(obstacle), "", 0};
  };
  // Number 1 goes and 5 comes in its place, goes, and 6 comes; 0 moves; 2 moves and goes. Sorted by
  // kind, as an engine has them.
  const std::vector<sim::Event> events = {{7, RobotId(0), Kind::kContact, BodyId(3), "", 0},
                                          event(Kind::kObstacleAdded, 5),
                                          event(Kind::kObstacleAdded, 6),
                                          event(Kind::kObstacleMoved, 0),
                                          event(Kind::kObstacleMoved, 2),
                                          event(Kind::kObstacleRemoved, 1),
                                          event(Kind::kObstacleRemoved, 2),
                                          event(Kind::kObstacleRemoved, 5)};
  std::vector<std::pair<Kind, std::uint32_t>> made;
  for (const sim::Event& done : obstacle_events_in_order(events)) {
    made.emplace_back(done.kind, done.other.value());
  }
  const std::vector<std::pair<Kind, std::uint32_t>> expected = {
      {Kind::kObstacleRemoved, 1}, {Kind::kObstacleRemoved, 2}, {Kind::kObstacleMoved, 0},
      {Kind::kObstacleAdded, 5},   {Kind::kObstacleRemoved, 5}, {Kind::kObstacleAdded, 6}};
  EXPECT_EQ(made, expected);
}

TEST(TwinErrors, PointAtTheScenario) {
  Host host;
  const std::string both =
      host.error_of(robot(kTwin, "changes:\n  - {at_s: 0, robot: anna, hand_over: real}\n"));
  EXPECT_EQ(both,
            "s.yaml:4:22: `hand_over`: both sets of drivers of robot `anna` are simulated; say "
            "`first` or `twin`");
  const std::string word =
      host.error_of(robot(kTwin, "changes:\n  - {at_s: 0, robot: anna, hand_over: twn}\n"));
  EXPECT_TRUE(word.starts_with("s.yaml:4:")) << word;
  EXPECT_NE(word.find("did you mean `twin`"), std::string::npos) << word;
  const std::string none =
      host.error_of(robot("", "changes:\n  - {at_s: 0, robot: anna, hand_over: twin}\n"));
  EXPECT_EQ(none, "s.yaml:4:22: `hand_over`: robot `anna` has no `twin` with other drivers");
  const std::string two = host.error_of(robot(
      kTwin, "changes:\n  - {at_s: 0, robot: anna, hand_over: twin, set: {body.scale: 2}}\n"));
  EXPECT_NE(two.find("two changes"), std::string::npos) << two;
  const std::string shadow = host.error_of(robot(std::string(kTwin) + ", shadow: true"));
  EXPECT_NE(shadow.find("are both simulated"), std::string::npos) << shadow;
  const std::string alone = host.error_of(robot(", shadow: true"));
  EXPECT_NE(alone.find("`shadow` needs `twin`"), std::string::npos) << alone;
  const std::string missing = host.error_of(robot(", twin: ../robots/nobody.yaml"));
  EXPECT_TRUE(missing.starts_with("s.yaml:4:")) << missing;
  const std::string hosts = host.error_of(robot(kTwin, "processes: 1\n"));
  EXPECT_NE(hosts.find("one process"), std::string::npos) << hosts;
}

TEST(TwinErrors, SayWhatMustBeTheSame) {
  Host host;
  const std::string other = ", twin_robot: {" + kBody + ", " + kWheels + "}";
  const std::string error = host.error_of(robot(other));
  EXPECT_TRUE(error.starts_with("s.yaml:4:")) << error;
  EXPECT_NE(error.find("the twin of robot `anna` has another "), std::string::npos) << error;
}

}  // namespace
}  // namespace rave::runtime::testing
