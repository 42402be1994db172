// SPDX-License-Identifier: Apache-2.0
// Two robots with the same topics are not taken for one.
#include "ros2_bench.hpp"

namespace rave::ros2_driver {
namespace {

using testing::LiveSensor;
using testing::LiveSink;

/// Its odometry and its pose say that it is elsewhere.
std::unique_ptr<testing::PeerProcess> start_double(const Ros2Bench& bench) {
  return std::make_unique<testing::PeerProcess>(
      "peer_ros2", std::vector<std::string>{"--room", bench.room(), "--pose", "4,1.5,0", "--domain",
                                            std::to_string(Ros2Bench::domain())});
}

TEST(Ros2TwoRobots, OneIsReadAndNoneIsDriven) {
  Ros2Bench bench;
  bench.given["lost_after_s"] = 0.5;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  LiveSensor tf_pose(bench.plugin, "ros2_tf_pose");
  LiveSensor pose(bench.plugin, "ros2_pose");
  ASSERT_EQ(tf_pose.configure({}, bench.device.base()), "");
  ASSERT_EQ(pose.configure({}, bench.device.base()), "");
  ASSERT_EQ(bench.odometry.configure({}, bench.device.base()), "");
  ASSERT_EQ(bench.laser.configure({}, bench.device.base()), "");
  ASSERT_NO_FATAL_FAILURE(bench.open());
  LiveSink<PoseReading> tf_poses(ReadingKind::kPose, 1);
  LiveSink<PoseReading> poses(ReadingKind::kPose, 1);
  ASSERT_EQ(tf_pose.open(tf_poses), "");
  ASSERT_EQ(pose.open(poses), "");
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)), "");
  auto second = start_double(bench);
  for (LiveSensor* const sensor : {&tf_pose, &pose, &bench.odometry, &bench.laser}) {
    testing::await_answer([&] { return sensor->report(); },
                          [](const nlohmann::json& report) { return report["passed_over"] > 5; });
    EXPECT_NE(sensor->report()["trouble"].get<std::string>().find("two writers of `/"),
              std::string::npos);
  }
  for (const auto* const sink : {&tf_poses, &poses}) {
    for (const auto& sample : sink->samples()) EXPECT_LT(sample.records.front().x_m, 2);
  }
  for (const auto& scan : bench.scans->samples()) EXPECT_GT(scan.records[90], 4);
  EXPECT_EQ(bench.drive.write(velocity_command(0.1, 0)).substr(0, 43),
            "`/cart/cmd_vel` has 2 readers, `cart` (GID ");
  bench.await_state(testing::wheels_stand);
  EXPECT_TRUE(testing::wheels_stand(testing::state_of(*second)));
  // When the first is silent the second takes its place, and that is said.
  bench.peer->tell("mute");
  poses.await_record([](const PoseReading& reading) { return reading.x_m > 3; });
  EXPECT_NE(bench.said().find("from now on `/cart/pose` is that of `cart` (GID "),
            std::string::npos);
  tf_pose.close();
  pose.close();
}

TEST(Ros2TwoRobots, OfTwoAtTheStartEachTopicIsThatOfTheSame) {
  Ros2Bench bench;
  auto second = start_double(bench);
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  LiveSensor tf_pose(bench.plugin, "ros2_tf_pose");
  LiveSensor pose(bench.plugin, "ros2_pose");
  ASSERT_EQ(tf_pose.configure({}, bench.device.base()), "");
  ASSERT_EQ(pose.configure({}, bench.device.base()), "");
  LiveSink<PoseReading> tf_poses(ReadingKind::kPose, 1);
  LiveSink<PoseReading> poses(ReadingKind::kPose, 1);
  ASSERT_EQ(bench.device.open(), "");
  ASSERT_EQ(tf_pose.open(tf_poses), "");
  ASSERT_EQ(pose.open(poses), "");
  // Both are known when both have been passed over.
  for (LiveSensor* const sensor : {&tf_pose, &pose}) {
    testing::await_answer([&] { return sensor->report(); },
                          [](const nlohmann::json& report) { return report["passed_over"] > 5; });
  }
  tf_poses.await_more(3);
  poses.await_more(3);
  EXPECT_NEAR(tf_poses.samples().back().records.front().x_m,
              poses.samples().back().records.front().x_m, 1e-9);
  tf_pose.close();
  pose.close();
}

TEST(Ros2TwoRobots, ARecorderMayBeAllowed) {
  Ros2Bench bench;
  bench.driving["most_readers"] = 2.0;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  auto second = start_double(bench);
  bench.keep_driving(0.2, 0);
  bench.await_state(testing::wheels_turn);
  testing::await_answer([&] { return testing::state_of(*second); }, testing::wheels_turn);
  bench.stop_driving();
}

}  // namespace
}  // namespace rave::ros2_driver
