// SPDX-License-Identifier: Apache-2.0
#include "ros2_bench.hpp"

namespace rave::ros2_driver {
namespace {

bool drives(const nlohmann::json& s) { return s["left_mps"] > 0.1; }

void expect_drives_and_knows_where(std::vector<std::string> options) {
  Ros2Bench bench(std::move(options));
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.4, 0);
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.5; });
  bench.keep_driving(0.1, 1.2);
  bench.poses->await_record([](const OdometryReading& r) { return r.yaw_rad > 1.5; });
  bench.stop_driving();
  const auto now = bench.await_standstill();
  const OdometryReading reading = bench.poses->samples().back().records.front();
  EXPECT_NEAR(1 + reading.x_m, now["x"].get<double>(), 1e-5);
  EXPECT_NEAR(1.5 + reading.y_m, now["y"].get<double>(), 1e-5);
  EXPECT_NEAR(reading.yaw_rad, now["yaw"].get<double>(), 1e-5);
  EXPECT_EQ(now["bad_commands"], 0);
  EXPECT_EQ(bench.poses->queue().complaint(), "");
  EXPECT_EQ(bench.odometry.report()["refused"], 0);
}

TEST(Ros2Drive, ByTwist) { expect_drives_and_knows_where({}); }
TEST(Ros2Drive, ByTwistStamped) { expect_drives_and_knows_where({"--stamped", "1"}); }

TEST(Ros2Drive, TheDriverStopsTheRobotWhenNobodyGivesCommands) {
  // The robot's own watchdog would hide that of the driver.
  Ros2Bench bench({"--watchdog-ms", "0"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(0.4, 0)), "");
  bench.await_state(drives);
  bench.await_standstill();
  EXPECT_NE(bench.said().find("`/cart/cmd_vel`: no command for 0.25 s"), std::string::npos)
      << bench.said();
}

TEST(Ros2Drive, TheRefreshKeepsTheWatchdogOfTheRobotQuiet) {
  Ros2Bench bench;
  bench.driving = {{"watchdog_s", 10.0}};
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(0.4, 0)), "");
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.6; });
  EXPECT_EQ(bench.state()["watchdog_stops"], 0);
}

TEST(Ros2Drive, ClosingTellsTheRobotToStand) {
  Ros2Bench bench({"--watchdog-ms", "0"});
  bench.driving = {{"watchdog_s", 10.0}};
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(0.4, 0)), "");
  bench.await_state(drives);
  bench.close();
  bench.await_state(testing::wheels_stand);
  ASSERT_NO_FATAL_FAILURE(bench.open());
  ASSERT_EQ(bench.drive.write(velocity_command(0.4, 0)), "") << "after a reset of the run";
  bench.await_state(drives);
}

TEST(Ros2Drive, CommandsAreHeldWithinTheLimits) {
  Ros2Bench bench;
  bench.driving = {{"max_v_mps", 0.2}, {"max_w_radps", 0.5}, {"watchdog_s", 10.0}};
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(9, -9)), "");
  const auto now = bench.await_state([](const nlohmann::json& s) { return s["commands"] > 0; });
  EXPECT_EQ(now["v_mps"], 0.2);
  EXPECT_EQ(now["w_radps"], -0.5);
  ASSERT_EQ(bench.drive.write(velocity_command(NAN, 0.1)), "");
  bench.await_state([](const nlohmann::json& s) { return s["v_mps"] == 0 && s["w_radps"] == 0.1; });
  EXPECT_EQ(bench.state()["bad_commands"], 0);
}

TEST(Ros2Drive, AKilledRobotIsReportedAndOneThatSpeaksAgainIsTakenBack) {
  Ros2Bench bench;
  bench.given["lost_after_s"] = 0.3;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("mute");
  const std::string why = bench.poses->await_failure();
  EXPECT_EQ(why,
            "no message has come on `/cart/odom` for 0.3 s: another participant writes "
            "`/cart/odom`, but no message came");
  // One silent sensor may be dead by itself: the robot is when all of them are.
  (void)bench.scans->await_failure();
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)),
            "the robot behind `/cart/cmd_vel` is silent; it may not receive commands either");
  bench.peer->tell("speak");
  bench.poses->await_recovery();
  bench.scans->await_recovery();
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)), "");
  bench.peer->tell("die");
  (void)bench.poses->await_failure();
  (void)bench.scans->await_failure();
  EXPECT_NE(bench.drive.write(velocity_command(0.1, 0)), "");
  EXPECT_GE(bench.odometry.report()["losses"], 2);
}

}  // namespace
}  // namespace rave::ros2_driver
