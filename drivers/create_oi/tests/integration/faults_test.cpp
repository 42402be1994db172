// SPDX-License-Identifier: Apache-2.0
#include "create_bench.hpp"
#include "rave/base_testing/no_threads.hpp"

namespace rave::oi {
namespace {

/// Drives in circles while the line is bad; the odometry must be right all the same.
nlohmann::json drive_with(const std::string& fault) {
  CreateBench bench;
  bench.start();
  if (::testing::Test::HasFatalFailure()) return {};
  bench.keep_driving(0.2, 0.8);
  bench.peer->tell(fault + " 100");
  (void)bench.peer->wait_for("spoilt");
  bench.poses->await_more(20);
  bench.stop_driving();
  bench.expect_true_pose(bench.await_standstill(), 0.02, 0.05);
  EXPECT_EQ(bench.poses->queue().failure(), "");
  EXPECT_EQ(bench.poses->queue().complaint(), "");
  nlohmann::json report = bench.device.report();
  EXPECT_TRUE(report["connected"]);
  return report;
}

std::int64_t dropped(const nlohmann::json& report) {
  return report["bad_checksum"].get<std::int64_t>() + report["skipped_bytes"].get<std::int64_t>();
}

TEST(CreateFaults, TornFramesAreDroppedAndTheNextIsFound) {
  EXPECT_GT(dropped(drive_with("tear")), 0);
}
TEST(CreateFaults, GarbledFramesAreDropped) { EXPECT_GT(dropped(drive_with("garble")), 0); }
TEST(CreateFaults, RepeatedBytesDoNotCountTwice) { (void)drive_with("repeat"); }
TEST(CreateFaults, FramesThatPauseInTheMiddleAreWhole) {
  EXPECT_EQ(drive_with("delay")["bad_checksum"], 0);
}

TEST(CreateFaults, WithoutAThreadTheRobotIsNotOpenedAndStands) {
  CreateBench bench;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  ASSERT_EQ(bench.drive.open({}, bench.device.base()), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(bench.device.open().find("cannot start the thread of the robot: "), 0U);
    (void)bench.drive.write(velocity_command(0.2, 0));
  }
  const nlohmann::json now = bench.state();
  EXPECT_EQ(now["left_mps"], 0);
  EXPECT_EQ(now["right_mps"], 0);
  ASSERT_NO_FATAL_FAILURE(bench.start());
}

TEST(CreateFaults, CommandsThatAreTornDoNotLastBecauseTheyAreRepeated) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.2, 0.8);
  bench.peer->tell("deafen 40");
  // A torn command may be any other; in the end the robot drives as it is told.
  bench.await_state([&](const nlohmann::json& s) {
    return s["deaf"] == 0 && s["mode"] == "safe" &&
           std::abs(s["left_mps"].get<double>() - 0.106) < 0.003 &&
           std::abs(s["right_mps"].get<double>() - 0.294) < 0.003;
  });
  bench.stop_driving();
  bench.expect_true_pose(bench.await_standstill(), 0.02, 0.05);
}

}  // namespace
}  // namespace rave::oi
