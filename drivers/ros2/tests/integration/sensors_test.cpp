// SPDX-License-Identifier: Apache-2.0
#include "ros2_bench.hpp"

namespace rave::ros2_driver {
namespace {

using testing::LiveSensor;
using testing::LiveSink;

TEST(Ros2Sensors, TheLaserSeesTheRoom) {
  Ros2Bench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  const HardwareDeclaration& declared = bench.laser.declaration();
  ASSERT_EQ(declared.capacity, 181U);
  EXPECT_NEAR(declared.bearings_rad[0], -M_PI / 2, 1e-6);
  EXPECT_NEAR(declared.bearings_rad[90], 0, 1e-6);
  EXPECT_NEAR(declared.range_min_m, 0.05, 1e-6);
  const auto scan = bench.scans->samples().back();
  EXPECT_NEAR(scan.records[90], 4.95, 1e-5) << "the laser sits 0.05 m ahead of the middle";
  EXPECT_NEAR(scan.records[0], 1.5, 1e-5);
  EXPECT_NEAR(scan.records[180], 1.5, 1e-5);
}

/// As small lidars that spin have it: each turn has another number of rays.
TEST(Ros2Sensors, ALaserWhoseNumberOfRaysVariesIsReadWhole) {
  Ros2Bench bench({"--rays", "450,457,451,455,720,721", "--scan-hz", "100"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.scans->await_more(60);
  EXPECT_EQ(bench.laser.report()["refused"], 0);
  const HardwareDeclaration& declared = bench.laser.declaration();
  for (const auto& scan : bench.scans->samples()) {
    ASSERT_EQ(scan.records.size(), declared.capacity);
    for (std::size_t i = 0; i < scan.records.size(); ++i) {
      // The room is 3 m wide and ends 4.95 m ahead of the laser.
      const double bearing = declared.bearings_rad[i];
      const double wall = std::min(4.95 / std::max(std::cos(bearing), 1e-9),
                                   1.5 / std::max(std::abs(std::sin(bearing)), 1e-9));
      EXPECT_NEAR(scan.records[i], wall, 0.03 * wall + 1e-3) << bearing;
    }
  }
}

/// What comes is what was sent: in its pattern, each message of the peer follows from one number.
TEST(Ros2Sensors, TenThousandSamplesWithoutABadOne) {
  Ros2Bench bench({"--odom-hz", "500", "--scan-hz", "250", "--rays", "361"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("pattern");
  bench.poses->await_record([](const OdometryReading& r) {
    return r.y_m == -r.x_m && r.v_mps == r.x_m / 2 && r.x_m > 0;
  });
  bench.scans->await_more(5);
  const std::size_t first_pose = bench.poses->samples().size();
  const std::size_t first_scan = bench.scans->samples().size();
  while (bench.poses->samples().size() + bench.scans->samples().size() <
         first_pose + first_scan + 10'000) {
    bench.poses->await_more(500);
  }
  const auto poses = bench.poses->samples();
  std::size_t bad = 0;
  for (std::size_t i = first_pose; i < poses.size(); ++i) {
    const OdometryReading& r = poses[i].records.front();
    bad +=
        r.y_m == -r.x_m && r.v_mps == r.x_m / 2 && poses[i].stamp >= poses[i - 1].stamp ? 0U : 1U;
  }
  const auto scans = bench.scans->samples();
  for (std::size_t i = first_scan; i < scans.size(); ++i) {
    bool good = scans[i].records.size() == 361;
    for (std::size_t k = 0; good && k < 361; ++k) {
      const double expected = scans[i].records[0] + static_cast<double>(k) * 1e-3;
      good = std::abs(scans[i].records[k] - expected) < 1e-5;
    }
    bad += good ? 0U : 1U;
  }
  EXPECT_EQ(bad, 0U);
  EXPECT_EQ(bench.odometry.report()["refused"], 0);
  EXPECT_EQ(bench.laser.report()["refused"], 0);
  EXPECT_EQ(bench.poses->queue().complaint(), "");
}

TEST(Ros2Sensors, GarbageIsRefusedAndTheRestGoesOn) {
  Ros2Bench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("garbage 3");
  bench.poses->await_more(30);
  bench.scans->await_more(5);
  EXPECT_EQ(bench.odometry.report()["refused"], 6);
  const auto laser = bench.laser.report();
  EXPECT_GE(laser["refused"], 6) << "a long one may get lost on its way";
  EXPECT_NE(laser["trouble"], "");
  // How many of them are looked at together, and so which one is named, is not certain.
  EXPECT_NE(bench.said().find("`/cart/scan`: "), std::string::npos) << bench.said();
  EXPECT_NE(bench.said().find(" refused so far: "), std::string::npos) << bench.said();
  for (const auto& scan : bench.scans->samples()) {
    EXPECT_NEAR(scan.records[90], 4.95, 1e-5);
  }
}

TEST(Ros2Sensors, TheOtherKinds) {
  Ros2Bench bench;
  ASSERT_EQ(bench.device.configure(bench.given, bench.host()), "");
  LiveSensor pose(bench.plugin, "ros2_pose");
  LiveSensor tf_pose(bench.plugin, "ros2_tf_pose");
  LiveSensor odometry_pose(bench.plugin, "ros2_odometry_pose");
  LiveSensor range(bench.plugin, "ros2_range");
  LiveSensor imu(bench.plugin, "ros2_imu");
  LiveSensor battery(bench.plugin, "ros2_battery");
  for (LiveSensor* const sensor : {&pose, &tf_pose, &odometry_pose, &range, &imu, &battery}) {
    ASSERT_EQ(sensor->configure({}, bench.device.base()), "") << sensor->info().name;
  }
  EXPECT_NEAR(range.declaration().cone_rad, 0.3, 1e-6);
  EXPECT_NEAR(range.declaration().range_max_m, 4, 1e-6);
  ASSERT_EQ(bench.device.open(), "");
  LiveSink<PoseReading> poses(ReadingKind::kPose, 1);
  LiveSink<PoseReading> tf_poses(ReadingKind::kPose, 1);
  LiveSink<PoseReading> odometry_poses(ReadingKind::kPose, 1);
  LiveSink<float> ranges(ReadingKind::kRanges, 1);
  LiveSink<double> attitudes(ReadingKind::kValues, 10);
  LiveSink<double> charges(ReadingKind::kValues, 6);
  ASSERT_EQ(pose.open(poses), "");
  ASSERT_EQ(tf_pose.open(tf_poses), "");
  ASSERT_EQ(odometry_pose.open(odometry_poses), "");
  ASSERT_EQ(range.open(ranges), "");
  ASSERT_EQ(imu.open(attitudes), "");
  ASSERT_EQ(battery.open(charges), "");
  for (auto* const sink : {&poses, &tf_poses}) {
    sink->await_more(3);
    const PoseReading reading = sink->samples().back().records.front();
    EXPECT_NEAR(reading.x_m, 1, 1e-9);
    EXPECT_NEAR(reading.y_m, 1.5, 1e-9);
    EXPECT_NEAR(reading.variance_xy_m2, 0.0004, 1e-9);
  }
  odometry_poses.await_more(3);
  EXPECT_NEAR(odometry_poses.samples().back().records.front().x_m, 0, 1e-9);
  EXPECT_NEAR(odometry_poses.samples().back().records.front().variance_xy_m2, 1e-4, 1e-9);
  ranges.await_more(2);
  EXPECT_NEAR(ranges.samples().back().records.front(), 1, 1e-5);
  attitudes.await_more(2);
  EXPECT_EQ(attitudes.samples().back().records[3], 1);
  EXPECT_NEAR(attitudes.samples().back().records[9], 9.81, 1e-9);
  charges.await_more(1);
  EXPECT_EQ(charges.samples().back().records[0], 0.5);
  for (LiveSensor* const sensor : {&pose, &tf_pose, &odometry_pose, &range, &imu, &battery}) {
    sensor->close();
  }
}

/// The room's corner is the peer's origin, and x is east.
const testing::Given kGps{{"geo_origin", std::vector<double>{47.3769, 8.5417, 408}}};

TEST(Ros2Sensors, SatelliteNavigationIsAPose) {
  Ros2Bench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  LiveSensor gps(bench.plugin, "ros2_gps");
  LiveSensor steered(bench.plugin, "ros2_gps");
  ASSERT_EQ(gps.configure(kGps, bench.device.base()), "");
  testing::Given with_imu = kGps;
  with_imu["imu_topic"] = "imu";
  ASSERT_EQ(steered.configure(with_imu, bench.device.base()), "");
  LiveSink<PoseReading> places(ReadingKind::kPose, 1);
  LiveSink<PoseReading> poses(ReadingKind::kPose, 1);
  ASSERT_EQ(gps.open(places), "");
  ASSERT_EQ(steered.open(poses), "");
  places.await_more(2);
  const PoseReading first = places.samples().back().records.front();
  EXPECT_NEAR(first.x_m, 1, 1e-3);
  EXPECT_NEAR(first.y_m, 1.5, 1e-3);
  EXPECT_NEAR(first.variance_xy_m2, 4e-4, 1e-12);
  EXPECT_GT(first.variance_yaw_rad2, 9) << "it has not moved";
  bench.keep_driving(0.4, 0);
  places.await_record([](const PoseReading& r) { return r.x_m > 2 && r.variance_yaw_rad2 < 1; });
  bench.keep_driving(0.1, 1.2);
  poses.await_record([](const PoseReading& r) { return r.yaw_rad > 1.5; });
  bench.stop_driving();
  const auto now = bench.await_standstill();
  poses.await_more(3);
  const PoseReading last = poses.samples().back().records.front();
  EXPECT_NEAR(last.x_m, now["x"].get<double>(), 1e-3);
  EXPECT_NEAR(last.y_m, now["y"].get<double>(), 1e-3);
  EXPECT_NEAR(last.yaw_rad, now["yaw"].get<double>(), 1e-3);
  gps.close();
  steered.close();
}

TEST(Ros2Sensors, AReceiverWithoutAFixIsThereButGivesNoPose) {
  Ros2Bench bench;
  bench.given["lost_after_s"] = 0.3;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  LiveSensor gps(bench.plugin, "ros2_gps");
  ASSERT_EQ(gps.configure(kGps, bench.device.base()), "");
  LiveSink<PoseReading> places(ReadingKind::kPose, 1);
  ASSERT_EQ(gps.open(places), "");
  places.await_more(2);
  bench.peer->tell("lose-fix");
  const auto refused = [&] { return gps.report(); };
  testing::await_answer(refused, [](const nlohmann::json& r) { return r["refused"] > 0; });
  const std::size_t before = places.samples().size();
  // Longer than a silence that would be a loss.
  testing::await_answer(refused, [](const nlohmann::json& r) { return r["refused"] > 5; });
  EXPECT_EQ(places.samples().size(), before);
  EXPECT_EQ(gps.report()["losses"], 0);
  EXPECT_EQ(gps.report()["trouble"], "the receiver has no fix");
  EXPECT_EQ(places.queue().failure(), "");
  bench.peer->tell("find-fix");
  places.await_more(2);
  bench.peer->tell("mute");
  EXPECT_NE(places.await_failure().find("no message has come on `/cart/fix`"), std::string::npos);
  gps.close();
}

}  // namespace
}  // namespace rave::ros2_driver
