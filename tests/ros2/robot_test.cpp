// SPDX-License-Identifier: Apache-2.0
// A robot of ROS 2 as a real robot of ours.

#include "rave/run_testing/ros2_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

/// robots/ros2-cart.yaml in the empty room of the peer, 6 m by 3 m, where a wall stands at x = 3 m
/// that is virtual.
class CartRun : public Ros2Run {
 public:
  /// `limits` are further lines of its guard. With `arm` it waits until somebody arms it.
  void start(double duration_s, const std::string& limits = "", bool arm = false) {
    write("room", "3 1.5 0 6 3\n");
    start_peer("peer_ros2", {"--room", file("room"), "--pose", "1,1.5,0"});
    std::ifstream stream(RAVE_SOURCE_DIR "/robots/ros2-cart.yaml");
    std::ostringstream cart;
    cart << stream.rdbuf();
    std::string robot = cart.str();
    const std::string guard = "guard:\n";
    const auto at = robot.find(guard);
    ASSERT_NE(at, std::string::npos);
    robot.insert(at + guard.size(), (arm ? "  arm: true\n" : "  arm: false\n") + limits);
    write("cart.yaml", robot);
    Ros2Run::start(
        "name: " + name() + "\nduration_s: " + std::to_string(duration_s) +
        "\nhistory_s: 1\nobstacles:\n  - {name: wall, box_m: [0.1, 3], x_m: 3.05, y_m: 1.5}\n"
        "robots:\n  - name: cart\n    file: cart.yaml\n    variables: {domain: " +
        std::to_string(ros2_domain()) + ", namespace: /cart}\n");
  }
  /// Another robot with the same topics.
  [[nodiscard]] std::unique_ptr<testing::PeerProcess> start_double() const {
    return std::make_unique<testing::PeerProcess>(
        "peer_ros2", std::vector<std::string>{"--room", file("room"), "--pose", "4,1.5,0",
                                              "--domain", std::to_string(ros2_domain())});
  }
  /// What `rave arm` says.
  [[nodiscard]] static std::string arm() {
    const std::string command = RAVE_BINARY_DIR "/bin/rave arm " + name() + " 2>&1";
    std::string said;
    FILE* const pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return said;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) said += static_cast<char>(c);
    ::pclose(pipe);
    return said;
  }
  /// Of the run; tests of several processes must not arm one another's.
  [[nodiscard]] static std::string name() { return "cart-" + std::to_string(::getpid()); }
};

TEST(Ros2Robot, DrivesByItsProgramAndFeelsAVirtualWall) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(12));
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result["whole"]) << result["problems"].dump();
  const Json& robot = result["robots"][0];
  EXPECT_EQ(robot["reality"], "real");
  EXPECT_TRUE(robot["obeys"]);
  EXPECT_GT(robot["way_m"], 1);
  EXPECT_EQ(result["devices"][0]["driver"], "ros2");
  const Json truth = run.await_state(testing::wheels_stand);
  EXPECT_GT(truth["farthest_x"], 2.2) << "it drove up to the wall";
  EXPECT_LT(truth["farthest_x"], 3.0 - 0.174) << "and not into it, though the real laser saw none";
  EXPECT_EQ(truth["touches"], 0);
  EXPECT_EQ(truth["bad_commands"], 0);
  EXPECT_EQ(result["events"]["contact"], 0);
  EXPECT_NEAR(robot["final_pose"]["x_m"].get<double>(), truth["x"].get<double>(), 0.1);
}

TEST(Ros2Robot, ARobotThatIsKilledIsMarkedAndTheRunGoesOn) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(600));
  run.await_state(testing::wheels_turn);
  run.peer->tell("die");
  // The pose is stale after 0.5 s, and what reads a topic says so after 1 s.
  run.await_console("driver failed", 4);
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 1) << "a loss is a problem of the run";
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  // Position, odometry, laser and wheels.
  EXPECT_EQ(result["events"]["driver_failed"], 4);
  EXPECT_GE(result["events"]["pose_stale"], 1);
}

/// While its odometry, its localisation and its wheels are well.
void expect_stop_by_laser(const std::string& trouble) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(600));
  run.await_state(testing::wheels_turn);
  run.peer->tell(trouble);
  run.await_console("sensor lost: `laser`", 1);
  const Json stopped = run.await_state(testing::wheels_stand);
  // The topic is reported as lost after 1 s, when the drive used to refuse for a moment and then
  // went on by the last scan.
  run.await_console("sensor `laser`: no ", 1);
  const int told = run.state()["commands"].get<int>();
  const Json later =
      run.await_state([&](const Json& now) { return now["commands"].get<int>() > told + 40; });
  for (const char* const key : {"x", "y", "yaw"}) EXPECT_EQ(later[key], stopped[key]) << trouble;
  run.peer->tell("see");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  (void)run.rave->wait();
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["events"]["driver_failed"], 1) << "of the laser, and not of the wheels";
  EXPECT_EQ(result["events"]["driver_back"], 1);
}

TEST(Ros2Robot, ALaserThatFallsSilentStopsTheRobotUntilItSpeaksAgain) {
  expect_stop_by_laser("blind");
}

TEST(Ros2Robot, ALaserThatReadsNothingButNegativeRangesStopsTheRobot) {
  expect_stop_by_laser("invert");
}

/// While its localisation repeats by a timer where the odometry began.
void expect_stop_by_pose(const std::string& trouble) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(600, "  fence_m: [[0, 0], [2, 0], [2, 3], [0, 3]]\n"));
  run.await_state(testing::wheels_turn);
  run.peer->tell(trouble);
  run.await_console("pose lost", 1);
  const Json stopped = run.await_state(testing::wheels_stand);
  EXPECT_LT(stopped["farthest_x"], 2 - 0.174) << trouble;
  const int told = run.state()["commands"].get<int>();
  const Json later =
      run.await_state([&](const Json& now) { return now["commands"].get<int>() > told + 40; });
  for (const char* const key : {"x", "y", "yaw"}) EXPECT_EQ(later[key], stopped[key]) << trouble;
  run.peer->tell("find-odometry");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  (void)run.rave->wait();
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_GE(result["events"]["pose_stale"], 1);
}

TEST(Ros2Robot, AnOdometryThatFallsSilentStopsTheRobotThoughTheMapIsRepeated) {
  expect_stop_by_pose("lose-odometry");
}

TEST(Ros2Robot, AnOdometryThatIsNotANumberStopsTheRobotThoughTheMapIsRepeated) {
  expect_stop_by_pose("spoil-odometry");
}

TEST(Ros2Robot, ARobotWhoseHostIsKilledStopsByItself) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(600));
  run.await_state(testing::wheels_turn);
  run.rave->kill();
  const Json now = run.await_state(testing::wheels_stand);
  EXPECT_GE(now["watchdog_stops"], 1);
}

TEST(Ros2Robot, IsNotArmedWhileASecondRobotHearsItsCommands) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(600, "", true));
  auto second = run.start_double();
  run.await_console("`/cart/cmd_vel` has 2 readers", 1);
  run.await_console("two writers of `/tf` to `odom`", 1);
  run.await_console("two writers of `/cart/scan`", 1);
  const std::string refused = CartRun::arm();
  EXPECT_NE(refused.find("robot `cart` cannot be driven: actuator `wheels`: `/cart/cmd_vel` has 2 "
                         "readers, `cart` (GID "),
            std::string::npos)
      << refused;
  second.reset();
  run.await_console("works again", 1);
  EXPECT_NE(CartRun::arm().find("armed cart"), std::string::npos);
  run.await_state(testing::wheels_turn);
  // Whoever comes while it drives makes both stand.
  second = run.start_double();
  run.await_console("`/cart/cmd_vel` has 2 readers", 2);
  run.await_state(testing::wheels_stand);
  EXPECT_TRUE(testing::wheels_stand(testing::state_of(*second)));
  run.rave->interrupt();
  (void)run.rave->wait();
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  // The pose is not that of the other, unless its own was silent for so long that it counts as
  // gone, which a loaded machine may bring about; then the log names both.
  if (run.said("from now on `/tf` to `odom` is that of") == 0) {
    EXPECT_LT(result["robots"][0]["final_pose"]["x_m"], 3);
  }
}

TEST(Ros2Robot, ARobotThatIsNotThereIsAnErrorOfTheStart) {
  CartRun run;
  ASSERT_NO_FATAL_FAILURE(run.start(5));
  run.peer->tell("mute");
  run.rave->kill();
  run.rave = std::make_unique<RaveRun>(run.file("scenario.yaml"), run.file("out"));
  EXPECT_EQ(run.rave->wait(), 2);
}

}  // namespace
}  // namespace rave::tests
