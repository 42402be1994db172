// SPDX-License-Identifier: Apache-2.0
// A real robot keeps away from a fence and a virtual wall however late the steps of its run come,
// and the result says that they were late. RAVE_OVERLOAD_ROUNDS says how often each is tried.
#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "rave/run_testing/create_run.hpp"
#include "rave/run_testing/ros2_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

constexpr double kSpeed_mps = 0.3;
constexpr double kRadius_m = 0.174;
constexpr double kFence_m = 2;
constexpr double kWall_m = 3;  ///< In the world of the run alone: the room goes on behind it.
/// The guard keeps out of the fence by itself; what is measured lies within the rounding of the
/// peers.
constexpr double kBeyond_m = 0.01;

struct Load {
  const char* name;
  double burn_ms;  ///< In each step of 10 ms.
};
constexpr Load kAll{"All", 0};
constexpr Load kThird{"Third", 30};
constexpr Load kTenth{"Tenth", 100};

struct Case {
  const char* peer;
  bool wall = false;  ///< Or else the fence.
  Load load;
  bool two = false;  ///< Processes.
};

std::string name_of(const Case& c) {
  return fmt::format("{}{}{}{}", c.peer, c.wall ? "Wall" : "Fence", c.load.name,
                     c.two ? "InTwo" : "InOne");
}

int rounds() {
  const char* const given = std::getenv("RAVE_OVERLOAD_ROUNDS");
  return given == nullptr ? 1 : std::max(1, std::atoi(given));
}

/// The drivers of a robot that drives straight on and can do nothing else.
std::string drivers_of(const std::string& peer, const testing::ScenarioRun& run, int mocap_port) {
  if (peer == "Ros2") {
    return fmt::format(
        "      pose_from: position\n      devices:\n        - {{name: base, driver: ros2, params: "
        "{{domain: {}, namespace: /cart, interface: 127.0.0.1, multicast: none}}}}\n"
        "      sensors:\n        - {{name: position, driver: ros2_tf_pose, device: base}}\n"
        "        - name: laser\n          driver: hybrid_ranges\n          max_age_s: 0.5\n"
        "          params: {{rule: occlusion}}\n          mount: {{x_m: 0.05, z_m: 0.12}}\n"
        "          real: {{driver: ros2_laser, device: base}}\n"
        "          virtual: {{driver: virtual_laser, params: {{rays_of_real_half: true, "
        "range_min_m: 0.05, range_max_m: 8}}}}\n"
        "      actuators:\n        - {{name: wheels, driver: ros2_velocity, device: base, params: "
        "{{max_v_mps: 0.5, max_w_radps: 2}}}}\n",
        ros2_domain());
  }
  return fmt::format(
      "      pose_from: mocap\n      devices:\n        - {{name: base, driver: create_oi, params: "
      "{{device: '{}'}}}}\n"
      "      sensors:\n        - {{name: mocap, driver: udp_pose, params: {{body: create, port: "
      "{}}}}}\n"
      "        - name: laser\n          driver: hybrid_ranges\n          max_age_s: 0.5\n"
      "          params: {{rule: occlusion}}\n          mount: {{z_m: 0.12}}\n"
      "          real: {{driver: scip_laser, params: {{device: '{}'}}}}\n"
      "          virtual: {{driver: virtual_laser, params: {{rays_of_real_half: true, "
      "range_min_m: 0.05, range_max_m: 5}}}}\n"
      "      actuators:\n        - {{name: wheels, driver: create_drive, device: base}}\n",
      run.file("base"), mocap_port, run.file("laser"));
}

class OverloadRun : public testing::ScenarioRun {
 public:
  explicit OverloadRun(const Case& c) : ScenarioRun("overload"), case_(c) {
    write("room", "3 1.5 0 6 3\n");
    const int mocap_port = free_port();
    if (c.peer == std::string("Ros2")) {
      peer = std::make_unique<testing::PeerProcess>(
          "peer_ros2", std::vector<std::string>{"--room", file("room"), "--pose", "1,1.5,0",
                                                "--domain", std::to_string(ros2_domain())});
    } else {
      peer = std::make_unique<testing::PeerProcess>(
          "peer_create",
          std::vector<std::string>{"--link", file("base"), "--laser-link", file("laser"),
                                   "--mocap-port", std::to_string(mocap_port), "--mocap-body",
                                   "create", "--room", file("room"), "--pose", "1,1.5,0",
                                   "--mocap-delay-s", "0.01", "--log", file("log")});
    }
    write("scenario.yaml", scenario(drivers_of(c.peer, *this, mocap_port)));
    rave = std::make_unique<RaveRun>(
        file("scenario.yaml"), file("out"),
        std::vector<std::string>{"--no-picture", "--plugins",
                                 RAVE_BINARY_DIR "/tests/plugins/overload"});
  }

  /// Where it thinks too long from: so near that it cannot but be blind there at full speed.
  [[nodiscard]] double onset_m() const { return case_.wall ? 2.3 : 1.7; }

  /// Has been there, and stands for a second; what it is then.
  Json await_stand() {
    int looks = 0;
    return await_state([&](const Json& s) {
      const bool there = s["x"].get<double>() > onset_m();
      const bool stands = s["left_mps"] == 0.0 && s["right_mps"] == 0.0;
      looks = there && stands ? looks + 1 : 0;
      return looks > 100;
    });
  }

 private:
  [[nodiscard]] std::string scenario(const std::string& drivers) const {
    const std::string burn = fmt::format("burn_ms: {}", case_.load.burn_ms);
    std::string text = fmt::format(
        "name: overload\nduration_s: 600\nmax_missed_pct: 1\nhistory_s: 1\nrobots:\n"
        "  - name: cart\n    pose: {{x_m: 1, y_m: 1.5}}\n    robot:\n"
        "      body: {{shapes: [{{disc_radius_m: {}, z_m: [0, 0.2]}}]}}\n"
        "{}      controllers: [{{name: drive, driver: velocity, actuator: wheels}}]\n"
        "      guard: {{arm: false{}}}\n"
        "      program: {{driver: charge, params: {{speed_mps: {}, stop_m: {}, from_x_m: {}, "
        "{}}}}}\n",
        kRadius_m, drivers,
        case_.wall ? "" : fmt::format(", fence_m: [[0, 0], [{0}, 0], [{0}, 3], [0, 3]]", kFence_m),
        kSpeed_mps, case_.wall ? 0.45 : 0, onset_m(), burn);
    // Looks at the other one, so that a run of two processes has a manager and a world.
    text +=
        "  - name: ghost\n    pose: {x_m: 1, y_m: -2}\n    robot:\n"
        "      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}\n"
        "      sensors: [{name: laser, driver: virtual_laser, mount: {z_m: 0.1}, params: {fov_deg: "
        "180, rays: "
        "91, range_max_m: 6}}]\n";
    if (case_.wall) {
      text += fmt::format("obstacles: [{{name: wall, box_m: [0.1, 3], x_m: {}, y_m: 1.5}}]\n",
                          kWall_m + 0.05);
    }
    if (case_.two) {
      text += "hosts:\n  - {name: lab, robots: [cart]}\n  - {name: desk, robots: [ghost]}\n";
    }
    return text;
  }

  Case case_;
};

/// The result says that steps came late, and what took the time.
void expect_told(const Json& result) {
  ASSERT_TRUE(result.is_object());
  EXPECT_FALSE(result["whole"]);
  const Json& late = result["lateness"];
  ASSERT_TRUE(late.is_object()) << result.dump(1);
  EXPECT_GT(late["missed_pct"], 1) << late.dump();
  EXPECT_GT(late["worst_s"], 0.05) << late.dump();
  EXPECT_GT(late["blame"].value("decide", 0), 0) << late.dump();
  EXPECT_NE(result["problems"].dump().find("of the deadlines were missed"), std::string::npos)
      << result["problems"].dump(1);
}

class Overload : public ::testing::TestWithParam<Case> {};

TEST_P(Overload, TheRobotKeepsOutOfWhatItMayNotEnterAndTheResultSaysWhatWasLate) {
  const Case& c = GetParam();
#ifndef RAVE_HAS_ROS2_PEER
  if (c.peer == std::string("Ros2")) GTEST_SKIP() << "without Fast DDS there is no such peer";
#endif
  for (int round = 0; round < rounds(); ++round) {
    OverloadRun run(c);
    const Json truth = run.await_stand();
    ASSERT_TRUE(truth.is_object());
    const double x_m = truth.value("farthest_x", truth["x"].get<double>());
    EXPECT_GT(x_m, run.onset_m()) << "it came to where it mattered";
    if (c.wall) {
      EXPECT_LT(x_m, kWall_m - kRadius_m) << "in the wall";
    } else {
      EXPECT_LT(x_m, kFence_m - kRadius_m + kBeyond_m) << "beyond the fence";
      RecordProperty("farthest_m", std::to_string(x_m));
    }
    run.rave->interrupt();
    const int code = run.rave->wait();
    const Json result = run.result();
    ASSERT_TRUE(result.is_object());
    // An end by hand is no failure; late steps are one, on whatever machine.
    EXPECT_EQ(code, result["whole"] == true ? 0 : 1) << result["problems"].dump();
    EXPECT_TRUE(c.load.burn_ms == 0 || code == 1) << result["lateness"].dump();
    if (c.load.burn_ms > 0) {
      ASSERT_NO_FATAL_FAILURE(expect_told(result));
      // Of two processes the other one may be late, too, if the machine is: then the guard stops
      // the cart, but not for steps of its own process.
      const Json& guard = result["guard"];
      const int stops = c.two
                            ? guard.value("cart", Json::object()).value("stopped by world lost", 0)
                            : result["lateness"]["robots_stopped"].get<int>();
      EXPECT_GE(stops, c.wall ? 1 : 0) << result["lateness"].dump() << guard.dump();
    } else {
      EXPECT_GT(result["lateness"]["deadlines"], 100) << result["lateness"].dump();
    }
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* const peer : {"Ros2", "Create"}) {
    for (const bool wall : {false, true}) {
      for (const Load& load : {kAll, kThird, kTenth}) {
        for (const bool two : {false, true}) all.push_back({peer, wall, load, two});
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Peers, Overload, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return name_of(instance.param); });

}  // namespace
}  // namespace rave::tests
