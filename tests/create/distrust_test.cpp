// SPDX-License-Identifier: Apache-2.0
// A motion capture that says where its robot is too late, or where it cannot be.
#include <fmt/format.h>

#include "rave/run_testing/create_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

constexpr double kRadius_m = 0.17;
constexpr double kFence_m = 3;
/// What the guard cannot know: the least delay of the motion capture (3 mm) and its noise.
constexpr double kUnknown_m = 0.01;

/// A cart that drives straight on at 0.3 m/s from x = 1 m, with a fence at x = 3 m and nothing else
/// on its way. A motion capture says where it is.
class StraightRun : public testing::ScenarioRun {
 public:
  StraightRun() : ScenarioRun("distrust") {
    write("room", "4 1.5 0 8 3\n");
    const int port = free_port();
    peer = std::make_unique<testing::PeerProcess>(
        "peer_create",
        std::vector<std::string>{"--link", file("base"), "--mocap-port", std::to_string(port),
                                 "--mocap-body", "cart", "--room", file("room"), "--pose",
                                 "1,1.5,0", "--mocap-noise-m", "0.001", "--mocap-delay-s", "0.01",
                                 "--log", file("log")});
    write("scenario.yaml",
          fmt::format(
              "name: distrust\nduration_s: 600\nrobots:\n  - name: cart\n"
              "    pose: {{x_m: 1, y_m: 1.5}}\n    robot:\n"
              "      body: {{shapes: [{{disc_radius_m: {0}, z_m: [0, 0.2]}}]}}\n"
              "      pose_from: mocap\n"
              "      devices: [{{name: base, driver: create_oi, params: {{device: '{1}'}}}}]\n"
              "      sensors: [{{name: mocap, driver: udp_pose, params: {{body: cart, port: "
              "{2}}}}}]\n"
              "      actuators: [{{name: wheels, driver: create_drive, device: base}}]\n"
              "      controllers: [{{name: drive, driver: velocity, actuator: wheels}}]\n"
              "      guard: {{arm: false, max_speed_mps: 0.35, max_turn_dps: 120, "
              "fence_m: [[0, 0], [{3}, 0], [{3}, 3], [0, 3]]}}\n"
              "      program: {{driver: charge, params: {{speed_mps: 0.3}}}}\n",
              kRadius_m, file("base"), port, kFence_m));
    rave = std::make_unique<RaveRun>(
        file("scenario.yaml"), file("out"),
        std::vector<std::string>{"--no-picture", "--plugins",
                                 RAVE_BINARY_DIR "/tests/plugins/overload"});
  }

  void await_x(double x_m) {
    const Json reached = await_state([&](const Json& s) { return s["x"].get<double>() > x_m; });
    ASSERT_TRUE(reached.is_object()) << "it never came to x = " << x_m;
  }
  /// Until it has stood for so long by the clock of the peer; where.
  double await_stand(double for_s) {
    double since_s = -1;
    double x_m = 0;
    const Json stood = await_state([&](const Json& s) {
      const double t_s = s["t_s"];
      const bool stands = s["left_mps"] == 0.0 && s["right_mps"] == 0.0;
      if (!stands || since_s < 0) since_s = t_s;
      x_m = s["x"];
      return stands && t_s - since_s > for_s;
    });
    EXPECT_TRUE(stood.is_object()) << "it never stood";
    return x_m;
  }
};

TEST(CreateDistrust, PosesThatComeLaterAndLaterStopItBeforeTheFence) {
  StraightRun run;
  ASSERT_NO_FATAL_FAILURE(run.await_x(1.3));
  run.peer->tell("mocap lag 0.5 3");
  // It stands while the lag grows, and when it does not grow any more.
  const double stood_m = run.await_stand(8);
  EXPECT_GT(stood_m, 1.3);
  EXPECT_LT(stood_m, kFence_m - kRadius_m + kUnknown_m);
  run.await_console("guard stopped", 1);
  run.rave->interrupt();
  static_cast<void>(run.rave->wait());
}

TEST(CreateDistrust, PosesThatCannotBeAreRefusedAndItDrivesOnByTheOthers) {
  StraightRun run;
  ASSERT_NO_FATAL_FAILURE(run.await_x(1.2));
  run.peer->tell("mocap far 1");
  run.await_console("pose refused", 1);
  ASSERT_NO_FATAL_FAILURE(run.await_x(1.5));
  run.peer->tell("mocap turn 3");
  run.await_console("pose refused", 2);
  const double stood_m = run.await_stand(1);
  EXPECT_GT(stood_m, kFence_m - kRadius_m - 0.1) << "it drove on";
  EXPECT_LT(stood_m, kFence_m - kRadius_m + kUnknown_m);
  run.rave->interrupt();
  static_cast<void>(run.rave->wait());
  const Json events = run.result()["events"];
  EXPECT_GE(events.value("pose_refused", 0), 2) << events.dump();
  EXPECT_EQ(events.value("disarmed", -1), 0) << events.dump();
}

TEST(CreateDistrust, WhoCarriesItAwayHasToArmIt) {
  StraightRun run;
  ASSERT_NO_FATAL_FAILURE(run.await_x(1.2));
  run.peer->tell("place 1 2.4 0");
  run.await_console("disarmed", 1);
  const double stood_m = run.await_stand(2);
  EXPECT_LT(stood_m, 1.5);
  EXPECT_EQ(CreateRun::rave_says("arm distrust --robot cart").exit_code, 0);
  run.await_x(stood_m + 0.3);
  run.rave->interrupt();
  static_cast<void>(run.rave->wait());
}

}  // namespace
}  // namespace rave::tests
