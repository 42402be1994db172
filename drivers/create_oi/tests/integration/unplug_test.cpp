// SPDX-License-Identifier: Apache-2.0
#include "create_bench.hpp"

namespace rave::oi {
namespace {

void expect_comes_back(bool tcp) {
  CreateBench bench({}, tcp);
  bench.given["lost_after_s"] = 100.0;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  for (int times = 0; times < 2; ++times) {
    bench.keep_driving(0.2, 0.8);
    bench.await_state([](const nlohmann::json& s) { return s["right_mps"] > 0.2; });
    bench.peer->tell("vanish");
    // Nobody can tell it to stop, so its own watchdog does.
    bench.await_state([](const nlohmann::json& s) { return s["right_mps"] == 0.0; });
    bench.peer->tell("return");
    bench.await_report([&](const nlohmann::json& r) { return r["connects"] == 2 + times; });
    bench.await_state([](const nlohmann::json& s) { return s["right_mps"] > 0.2; });
  }
  bench.stop_driving();
  const auto now = bench.await_standstill();
  // On a starved machine the driver's own watchdog may be the one that stops it, once.
  EXPECT_GE(now["watchdog_stops"], 1);
  EXPECT_LE(now["watchdog_still_ms"], 300) << "by the robot's own clock";
  EXPECT_GT(now["watchdog_still_ms"], 100);
  bench.expect_true_pose(now, 0.02, 0.05);
  EXPECT_EQ(bench.poses->queue().failure(), "") << "it was not away for long";
  EXPECT_EQ(bench.poses->queue().complaint(), "");
}

TEST(CreateUnplug, ComesBackAtTheTerminal) { expect_comes_back(false); }
TEST(CreateUnplug, ComesBackOverTcp) { expect_comes_back(true); }

TEST(CreateUnplug, AbsenceIsReportedAndSoIsTheReturn) {
  CreateBench bench;
  bench.given["lost_after_s"] = 0.3;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("vanish");
  const std::string why = bench.poses->await_failure();
  EXPECT_EQ(why.substr(0, why.rfind(':')),
            "the robot at `" + bench.link() +
                "` has been disconnected for more than 0.3 s: cannot open `" + bench.link() + "`");
  EXPECT_EQ(bench.touches->await_failure(), why);
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)),
            "the robot at `" + bench.link() + "` is disconnected; its wheels cannot be commanded");
  EXPECT_EQ(bench.device.report()["connected"], false);
  bench.peer->tell("return");
  bench.poses->await_recovery();
  bench.touches->await_recovery();
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)), "");
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.005; });
  EXPECT_NE(bench.said().find("is back"), std::string::npos) << bench.said();
}

TEST(CreateUnplug, SilenceIsNoticed) {
  CreateBench bench;
  bench.given["lost_after_s"] = 0.2;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("mute");
  const std::string why = bench.poses->await_failure();
  EXPECT_NE(why.find(": no valid frame for 0.5 s"), std::string::npos) << why;
  bench.peer->tell("speak");
  bench.poses->await_recovery();
}

TEST(CreateUnplug, ARobotThatWasRestartedIsStartedAnew) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.4, 0);
  bench.poses->await_record([](const OdometryReading& r) { return r.x_m > 0.4; });
  bench.stop_driving();
  bench.await_standstill();
  const OdometryReading before = bench.poses->samples().back().records.front();
  bench.peer->tell("reboot");  // off, and its counters begin at zero
  bench.await_report([](const nlohmann::json& r) { return r["connects"] >= 2; });
  bench.keep_driving(0.2, 0);
  bench.poses->await_record([&](const OdometryReading& r) { return r.x_m > before.x_m + 0.1; });
  EXPECT_EQ(bench.odometry.report()["restarts"], 1);
  const OdometryReading after = bench.poses->samples().back().records.front();
  EXPECT_GT(after.variance_xy_m2, before.variance_xy_m2 + 1e-3) << "the doubt of the pause";
}

TEST(CreateUnplug, ALiftedRobotIsTakenBackIntoItsMode) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.2, 0.8);
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] > 0.2; });
  bench.peer->tell("drop 3");
  bench.await_report([](const nlohmann::json& r) { return r["mode_losses"] == 1; });
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] == 0.0; });
  EXPECT_NE(
      bench.said().find("went from safe to passive mode and does not obey: a wheel has dropped"),
      std::string::npos)
      << bench.said();
  bench.poses->await_more(70);
  EXPECT_EQ(bench.state()["mode"], "passive") << "as long as it hangs";
  bench.peer->tell("drop 0");
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] > 0.2; });
  EXPECT_EQ(bench.device.report()["mode_losses"], 1);
}

TEST(CreateUnplug, AtACliffItMayOnlyDriveAway) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.2, 0);
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] > 0.1; });
  bench.peer->tell("cliff 2");
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] == 0.0; });
  bench.poses->await_more(70);
  EXPECT_EQ(bench.state()["mode"], "passive") << "forward it would fall";
  bench.keep_driving(-0.2, 0);
  bench.await_state([](const nlohmann::json& s) { return s["right_mps"] < -0.1; });
}

TEST(CreateUnplug, ClosesWhileTheRobotIsAway) {
  CreateBench bench;
  bench.given["lost_after_s"] = 0.1;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("vanish");
  (void)bench.poses->await_failure();
  bench.close();
}

}  // namespace
}  // namespace rave::oi
