// SPDX-License-Identifier: Apache-2.0
#include "create_bench.hpp"

namespace rave::oi {
namespace {

void expect_drives_and_knows_where(std::vector<std::string> options, bool tcp) {
  CreateBench bench(std::move(options), tcp);
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.3, 0);
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.5; });
  bench.keep_driving(0.1, 1.2);
  bench.poses->await_record([](const OdometryReading& r) { return r.yaw_rad > 1.5; });
  bench.stop_driving();
  bench.expect_true_pose(bench.await_standstill(), 0.01, 0.02);
  EXPECT_EQ(bench.poses->queue().complaint(), "");
  EXPECT_EQ(bench.poses->queue().failure(), "");
}

TEST(CreateDrive, OdometryKnowsWhereItDroveAtTheTerminal) {
  expect_drives_and_knows_where({}, false);
}
TEST(CreateDrive, OdometryKnowsWhereItDroveOverTcp) { expect_drives_and_knows_where({}, true); }
TEST(CreateDrive, AnotherClockCommandDelayAndMotorLagBreakNothing) {
  expect_drives_and_knows_where({"--clock-start-s", "3", "--drift-ppm", "200", "--command-delay-ms",
                                 "30", "--lag-s", "0.1", "--latency-ms", "5"},
                                false);
}

TEST(CreateDrive, SlipShowsAsTheGapBetweenOdometryAndTruth) {
  CreateBench bench({"--slip", "0.1,0.1"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.4, 0);
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 1; });
  bench.stop_driving();
  const auto now = bench.await_standstill();
  const double told_m = bench.poses->samples().back().records.front().x_m;
  EXPECT_NEAR(now["x"].get<double>() - 1, 0.9 * told_m, 0.01);
}

TEST(CreateDrive, TheDriverStopsTheWheelsWhenNobodyGivesCommands) {
  // The robot's own watchdog would hide that of the driver.
  CreateBench bench({"--watchdog-ms", "0"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(0.3, 0)), "");
  bench.await_state([](const nlohmann::json& s) { return s["left_mps"] > 0.1; });
  bench.await_standstill();
  EXPECT_EQ(bench.device.report()["watchdog_stops"], 1);
  EXPECT_NE(bench.said().find("received no command for too long"), std::string::npos)
      << bench.said();
  EXPECT_EQ(bench.state()["watchdog_stops"], 0);
}

TEST(CreateDrive, TheRefreshKeepsTheWatchdogOfTheRobotQuiet) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  // Given once and held by the driver for long: only the refresh feeds the robot's watchdog.
  testing::LiveActuator patient(bench.plugin, "create_drive");
  ASSERT_EQ(patient.open({{"watchdog_s", 10.0}}, bench.device.base()), "");
  ASSERT_EQ(patient.write(velocity_command(0.3, 0)), "");
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.5; });
  patient.close();
  bench.await_standstill();
  EXPECT_GT(bench.device.report()["drive_commands"], 20);
}

TEST(CreateDrive, ClosingStopsTheRobotAndLeavesItPassive) {
  CreateBench bench({"--watchdog-ms", "0"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  ASSERT_EQ(bench.drive.write(velocity_command(0.3, 0)), "");
  bench.await_state([](const nlohmann::json& s) { return s["left_mps"] > 0.1; });
  bench.close();
  const auto now = bench.await_state(
      [](const nlohmann::json& s) { return s["left_mps"] == 0.0 && s["mode"] == "passive"; });
  const auto& frames = now["frames"];
  ASSERT_NO_FATAL_FAILURE(bench.open()) << "and it opens again";
  EXPECT_EQ(bench.poses->samples().front().records.front().x_m, 0);
  EXPECT_GT(bench.state()["frames"], frames);
}

TEST(CreateDrive, OnlyVelocitiesAreTaken) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  EXPECT_EQ(bench.drive.write(goal_command(1, 1)), "expected velocities, found goal");
}

}  // namespace
}  // namespace rave::oi
