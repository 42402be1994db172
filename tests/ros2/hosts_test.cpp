// SPDX-License-Identifier: Apache-2.0
// Robots of ours on two hosts, each a process, as ROS 2 sees them.
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "rave/run_testing/ros2_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

/// Two equal robots, each on a host of its own, which `rest` is about.
std::string scenario(const std::string& rest, bool shown, const std::string& sensors = "",
                     const std::string& program = "{driver: cruise, period_s: 0.1}",
                     const std::string& devices = "") {
  std::string text = fmt::format("name: pair\nros2: {{domain: {}}}\nrobots:\n", ros2_domain());
  for (const std::string name : {"left", "right"}) {
    text += fmt::format(
        "  - name: {}\n    pose: {{x_m: 0, y_m: {}}}\n    robot:\n      ros2: {}\n"
        "      body: {{shapes: [{{disc_radius_m: 0.15, z_m: [0, 0.2]}}]}}\n"
        "      actuators: [{{name: wheels, driver: differential_drive}}]\n{}{}"
        "      sensors:\n        - {{name: odometry, driver: virtual_odometry}}\n"
        "        - {{name: laser, driver: virtual_laser, period_s: 0.05, mount: {{z_m: 0.1}}, "
        "params: {{rays: 31, fov_deg: 180, range_max_m: 8}}}}\n{}"
        "      controllers:\n        - {{name: drive, driver: velocity, actuator: wheels}}\n"
        "        - {{name: navigate, driver: goal_point, actuator: wheels}}\n"
        "      program: {}\n",
        name, name == "left" ? 2 : -2, shown, devices,
        devices.empty() ? "" : fmt::format(", namespace: /{}}}}}]\n", name), sensors, program);
  }
  return text + rest;
}

constexpr const char* kHosts =
    "hosts:\n  - {name: one, robots: [left]}\n  - {name: two, robots: [right]}\n";

/// One more peer beside that of the run.
std::unique_ptr<testing::PeerProcess> listener(const std::string& robot) {
  return std::make_unique<testing::PeerProcess>(
      "peer_ros2_listener", std::vector<std::string>{"--namespace", "/" + robot, "--domain",
                                                     std::to_string(ros2_domain())});
}

bool many(const Json& s, const char* kind) { return s.contains(kind) && s[kind]["count"] > 20; }

std::set<std::string> names_of(const Json& nodes) {
  std::set<std::string> names;
  for (const Json& node : nodes) names.insert(node["name"].get<std::string>());
  return names;
}

void expect_both_are_seen(const std::string& pace) {
  Ros2Run run;
  run.peer = listener("left");
  const auto right = listener("right");
  run.start(scenario(kHosts + pace + "duration_s: 10000\n", true));
  const auto sees_all = [](const Json& s) {
    return many(s, "odom") && many(s, "scan") && many(s, "clock") && s.contains("tf") &&
           s["tf"]["from"].size() == 2 && s.contains("tf_static") &&
           s["tf_static"]["from"].size() == 2 && s.contains("description") &&
           s["nodes"].size() == 2;
  };
  for (const Json& seen :
       {run.await_state(sees_all),
        testing::await_answer([&] { return testing::state_of(*right); }, sees_all)}) {
    EXPECT_EQ(seen["clock"]["from"].size(), 1U) << "a clock has one writer";
    EXPECT_EQ(seen["clock"]["bad"], 0) << "and never steps back";
    EXPECT_EQ(seen["odom"]["bad"], 0);
    EXPECT_EQ(seen["scan"]["bad"], 0);
    EXPECT_EQ(seen["description"]["count"], 1);
    EXPECT_EQ(names_of(seen["nodes"]), (std::set<std::string>{"rave_pair_one", "rave_pair_two"}));
  }
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
}

TEST(Ros2Hosts, EachShowsItsOwnRobotsAndOneTheTimeInLockStep) {
  expect_both_are_seen("pace: 10x\n");
}
TEST(Ros2Hosts, EachShowsItsOwnRobotsAndOneTheTimeInRealTime) {
  expect_both_are_seen("clock: real_time\n");
}

TEST(Ros2Hosts, WhatIsShownChangesNothing) {
  std::set<std::string> hashes;
  for (const bool shown : {true, false}) {
    for (const std::string hosts : {kHosts, ""}) {
      Ros2Run run;
      run.start(scenario(hosts + "duration_s: 5\npace: max\n", shown));
      EXPECT_EQ(run.rave->wait(), 0);
      hashes.insert(run.result()["hash"].get<std::string>());
    }
  }
  EXPECT_EQ(hashes.size(), 1U);
}

TEST(Ros2Hosts, CommandsReachARobotOnWhicheverHostItIs) {
  Ros2Run run;
  run.peer = listener("left");
  const auto right = listener("right");
  run.start(scenario(std::string(kHosts) + "duration_s: 600\n", true,
                     "        - {name: cmd_vel, driver: ros2_command, device: others}\n"
                     "        - {name: goal_pose, driver: ros2_goal, device: others}\n",
                     "{driver: obey, period_s: 0.05}",
                     "      devices: [{name: others, driver: ros2, params: {domain: " +
                         std::to_string(ros2_domain())));
  const auto said = [](const Json& s, const char* what) {
    return s.contains("odom") ? s["odom"]["said"][what].get<double>() : 0.0;
  };
  const auto state_of_right = [&] { return testing::state_of(*right); };
  right->tell("drive 0.4 0");
  testing::await_answer(state_of_right, [&](const Json& s) { return said(s, "x") > 0.4; });
  const Json still = run.await_state([](const Json& s) { return many(s, "odom"); });
  EXPECT_EQ(said(still, "x"), 0) << "the other one was told nothing";
  right->tell("release");
  // Odometry begins at (0, 2) in the map.
  run.peer->tell("goal 1 2.5");
  run.await_state([&](const Json& s) {
    return std::hypot(said(s, "x") - 1, said(s, "y") - 0.5) < 0.12 && said(s, "v") == 0;
  });
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
}

}  // namespace
}  // namespace rave::tests
