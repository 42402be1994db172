// SPDX-License-Identifier: Apache-2.0
// A robot of ours as ROS 2 sees it.
#include <algorithm>
#include <cmath>

#include "rave/run_testing/ros2_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

/// A simulated robot before a wall, for the place of a robot entry.
std::string robot(const std::string& sensors, const std::string& rest) {
  return "name: face\nobstacles:\n  - {name: wall, box_m: [0.1, 10], x_m: 5, y_m: 0}\n"
         "ros2: {domain: " +
         std::to_string(ros2_domain()) +
         "}\n"
         "geo_origin: {latitude_deg: 47.3769, longitude_deg: 8.5417, altitude_m: 408}\n"
         "robots:\n  - name: cart-1\n    pose: {x_m: 1, y_m: 0}\n    robot:\n"
         "      ros2: true\n"
         "      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.2]}, {box_m: [0.1, 0.1], z_m: "
         "[0.2, 0.3]}]}\n"
         "      actuators: [{name: wheels, driver: differential_drive}]\n"
         "      sensors:\n"
         "        - {name: odometry, driver: virtual_odometry}\n"
         "        - {name: laser, driver: virtual_laser, period_s: 0.05, mount: {x_m: 0.1, z_m: "
         "0.15}, params: {rays: 91, fov_deg: 180, range_max_m: 8}}\n"
         "        - {name: indoor, driver: indoor_positioning, period_s: 0.1}\n"
         "        - {name: rear, driver: virtual_sonar, mount: {yaw_deg: 180, z_m: 0.1}}\n" +
         sensors + rest;
}

std::int64_t total(const Json& state, const char* what) {
  std::int64_t sum = 0;
  for (const Json& kind : state) {
    if (kind.contains("count")) sum += kind[what].get<std::int64_t>();
  }
  return sum;
}

/// Ends the run before its time; nothing may be wrong with it.
void expect_ends_well(const Ros2Run& run) {
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
  EXPECT_EQ(run.result()["problems"], Json::array());
}

TEST(Ros2Face, TenThousandMessagesWithoutABadOne) {
  Ros2Run run;
  run.start_peer("peer_ros2_listener", {"--namespace", "/cart_1"});
  run.start(robot("",
                  "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
                  "      program: {driver: cruise, period_s: 0.1}\n"
                  "duration_s: 200\npace: 10x\n"));
  const Json seen = run.await_state([](const Json& s) { return total(s, "count") >= 10'000; });
  expect_ends_well(run);
  EXPECT_EQ(total(seen, "bad"), 0) << seen.dump();
  EXPECT_EQ(seen["odom"]["said"]["frame"], "cart_1/odom");
  EXPECT_EQ(seen["odom"]["said"]["child"], "cart_1/base_link");
  EXPECT_EQ(seen["scan"]["said"]["rays"], 91);
  EXPECT_NEAR(seen["scan"]["said"]["first"].get<double>(), -M_PI / 2, 1e-6);
  EXPECT_EQ(seen["scan"]["said"]["frame"], "cart_1/laser");
  EXPECT_GT(seen["range"]["count"], 10);
  EXPECT_EQ(seen["tf"]["said"], Json::array({"map>cart_1/odom", "cart_1/odom>cart_1/base_link"}));
  EXPECT_EQ(seen["tf_static"]["said"],
            Json::array({"cart_1/base_link>cart_1/odometry", "cart_1/base_link>cart_1/laser",
                         "cart_1/base_link>cart_1/indoor", "cart_1/base_link>cart_1/rear"}));
  EXPECT_EQ(seen["description"]["count"], 1);
  EXPECT_GT(seen["clock"]["said"], 1'000'000'000);
  const Json& fix = seen["fix"]["said"];
  EXPECT_GT(seen["fix"]["count"], 10);
  EXPECT_EQ(fix["status"], 0);
  EXPECT_EQ(fix["frame"], "cart_1/base_link");
  // By the time of the last message it has driven 80 m at most (200 s at 0.4 m/s); a degree of
  // latitude is 111 km, one of longitude 75 km there.
  EXPECT_NEAR(fix["latitude"].get<double>(), 47.3769, 8e-4);
  EXPECT_NEAR(fix["longitude"].get<double>(), 8.5417, 1.1e-3);
  EXPECT_NE(fix["longitude"], 8.5417);
  EXPECT_NEAR(fix["altitude"].get<double>(), 408, 1e-3);
  EXPECT_NEAR(fix["variance"].get<double>(), 0.0004, 1e-9);
}

/// All that one message of each kind came from, whose hash is of 64 digits.
void expect_nodes(const std::string& form, const std::string& gid_bytes) {
  Ros2Run run;
  run.start_peer("peer_ros2_listener", {"--namespace", "/cart_1", "--gid-bytes", gid_bytes});
  std::string scenario = robot("", "duration_s: 200\npace: realtime\n");
  scenario.replace(scenario.find("ros2: {"), 7, "ros2: {nodes: " + form + ", ");
  run.start(scenario);
  const std::string zeros(gid_bytes == "24" ? 16 : 0, '0');
  const auto writers = [](const Json& s) {
    return s["nodes"].empty() ? Json::array() : s["nodes"][0]["writers"];
  };
  const auto listed = [&](const Json& s, const char* kind) {
    if (!s.contains(kind)) return false;
    const auto is_listed = [&](const Json& from) {
      const Json all = writers(s);
      return std::find(all.begin(), all.end(), from.get<std::string>() + zeros) != all.end();
    };
    return std::all_of(s[kind]["from"].begin(), s[kind]["from"].end(), is_listed);
  };
  const Json seen = run.await_state([&](const Json& s) {
    return listed(s, "odom") && listed(s, "scan") && listed(s, "fix") && listed(s, "clock") &&
           listed(s, "tf") && listed(s, "tf_static") && listed(s, "description");
  });
  ASSERT_EQ(seen["nodes"].size(), 1U) << seen["nodes"].dump();
  const Json& node = seen["nodes"][0];
  EXPECT_EQ(node["namespace"], "/");
  EXPECT_EQ(node["name"], "rave_face");
  EXPECT_EQ(node["writers"].size(), 8U) << "three of the run and five of the robot";
  const std::string participant = node["participant"].get<std::string>().substr(0, 32);
  EXPECT_EQ(seen["enclaves"][participant], "enclave=/;");
  EXPECT_EQ(seen["hashes"]["rt/clock"],
            "typehash=RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564;");
  expect_ends_well(run);
}

TEST(Ros2Face, IsANodeWithItsWritersAsIronReadsIt) { expect_nodes("iron", "16"); }
TEST(Ros2Face, IsANodeWithItsWritersAsHumbleReadsIt) { expect_nodes("humble", "24"); }

void expect_obeys(const std::string& stamped) {
  Ros2Run run;
  run.start_peer("peer_ros2_listener", {"--namespace", "/cart_1", "--stamped", stamped});
  const std::string domain = std::to_string(ros2_domain());
  run.start(
      robot("        - {name: cmd_vel, driver: ros2_command, device: others, params: "
            "{message: " +
                std::string(stamped == "1" ? "twist_stamped" : "twist") +
                "}}\n"
                "        - {name: goal_pose, driver: ros2_goal, device: others}\n",
            "      devices: [{name: others, driver: ros2, params: {domain: " + domain +
                ", namespace: /cart_1}}]\n"
                "      controllers:\n"
                "        - {name: drive, driver: velocity, actuator: wheels}\n"
                "        - {name: navigate, driver: goal_point, actuator: wheels}\n"
                "      program: {driver: obey, period_s: 0.05}\n"
                "duration_s: 600\npace: realtime\n"));
  const auto said = [](const Json& s, const char* what) {
    return s.contains("odom") ? s["odom"]["said"][what].get<double>() : 0.0;
  };
  run.peer->tell("drive 0.4 0");
  run.await_state([&](const Json& s) { return said(s, "x") > 0.4; });
  run.peer->tell("release");
  run.await_state([&](const Json& s) { return said(s, "v") == 0; });
  // Its odometry began at (1, 0) in the map.
  run.peer->tell("goal 2 1");
  run.await_state([&](const Json& s) {
    return std::hypot(said(s, "x") - 1, said(s, "y") - 1) < 0.12 && said(s, "v") == 0;
  });
  expect_ends_well(run);
}

TEST(Ros2Face, ObeysTwistsAndGoals) { expect_obeys("0"); }
TEST(Ros2Face, ObeysStampedTwistsAndGoals) { expect_obeys("1"); }

}  // namespace
}  // namespace rave::tests
