// SPDX-License-Identifier: Apache-2.0
// A recording of which a player can play only a part: who reads the result is told.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "process.hpp"
#include "rave/record/run_record.hpp"
#include "rave/robot/reading.hpp"

namespace rave::cli_test {
namespace {

using nlohmann::json;

class StreamLoss : public testing::Test {
 protected:
  /// A log of 100 scans in a second, of which so many bear the stamp of the one before.
  void write_log(int repeated, bool logger_too) const {
    std::ofstream log(folder_.path() / "a.log");
    for (int i = 0; i < 100; ++i) {
      const double own_s = 10 + 0.01 * i;
      const double stamp_s = i > 0 && i <= repeated ? 10 : own_s;
      log << fmt::format("FLASER 2 1.5 2.5 {0} 0 0 {0} 0 0 {1:.2f} nohost {2:.2f}\n", 0.01 * i,
                         stamp_s, logger_too ? stamp_s : own_s);
    }
  }
  /// Runs a robot whose pose is that of the given sensor.
  Ended run(const std::string& pose_sensor) const {
    std::ofstream(folder_.path() / "scenario.yaml")
        << "name: lossy\nduration_s: 0.9\nrobots:\n  - name: it\n    robot:\n"
           "      body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
           "      pose_from: pose\n      staleness_s: 5\n      sensors:\n        - "
        << pose_sensor
        << "\n      actuators: [{name: wheels, driver: replay_ignored}]\n"
           "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n";
    return run_rave({"run", folder_.path() / "scenario.yaml", "--output", folder_.path() / "run",
                     "--replace", "--no-picture"});
  }
  Ended run_log() const {
    return run("{name: pose, driver: carmen_pose, params: {log: " + folder_.path().string() +
               "/a.log}}");
  }
  [[nodiscard]] json result() const {
    return json::parse(content_of(folder_.path() / "run" / "result.json"));
  }
  void expect_told(const Ended& ended, const std::string& loss) const {
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.err.find("note: " + loss), std::string::npos) << ended.err;
    EXPECT_EQ(result()["problems"], json::array({loss}));
    EXPECT_NE(content_of(folder_.path() / "run" / "summary.txt").find("lost"), std::string::npos);
  }

  TemporaryFolder folder_;
};

TEST_F(StreamLoss, OfACarmenLogWhoseStampsRepeatIsTold) {
  write_log(98, true);
  expect_told(run_log(),
              "sensor `pose` of robot `it` lost 98 of 100 readings (98.0 %): duplicate_stamp");
  EXPECT_EQ(result()["streams"][0]["dropped"],
            json({{"count", 98}, {"of", 100}, {"because", "duplicate_stamp"}}));
}

TEST_F(StreamLoss, WhatAPlayerRemarksIsToldOnce) {
  write_log(0, true);
  std::ofstream(folder_.path() / "a.log", std::ios::app) << "REMISSIONFLASER 1 2 3 4 h 4\n";
  const Ended ended = run_log();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  const std::string note = "robot `it`: log `" + folder_.path().string() +
                           "/a.log`: passed over rows of unknown messages: 1 x REMISSIONFLASER";
  EXPECT_NE(ended.err.find("note: " + note), std::string::npos) << ended.err;
  EXPECT_EQ(result()["problems"], json::array({note}));
}

TEST_F(StreamLoss, FromSixPercentOnIsTold) {
  write_log(6, true);
  expect_told(run_log(),
              "sensor `pose` of robot `it` lost 6 of 100 readings (6.0 %): duplicate_stamp");
  write_log(5, true);
  const Ended few = run_log();
  EXPECT_EQ(few.exit_code, 0) << few.err;
  EXPECT_EQ(result()["problems"], json::array());
  EXPECT_EQ(result()["streams"][0]["dropped"]["count"], 5);
}

TEST_F(StreamLoss, ThereIsNoneIfTheStampsOfTheLoggerDiffer) {
  write_log(98, false);
  const Ended ended = run_log();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(result()["problems"], json::array());
  EXPECT_EQ(result()["streams"][0]["rows"], 100);
  EXPECT_EQ(result()["streams"][0]["stamped_by"], "logger_timestamp");
}

TEST_F(StreamLoss, OfAUtiasLogIsTold) {
  for (const char* const name : {"Groundtruth", "Odometry", "Measurement"}) {
    std::ofstream file(folder_.path() / fmt::format("Robot1_{}.dat", name));
    for (int i = 0; i < 100; ++i) {
      const int pair = i / 2;
      const double stamp_s = 10 + 0.02 * pair;
      if (name[0] == 'M') {
        file << fmt::format("{:.2f} 5 1.0 0.1\n", stamp_s);
      } else if (name[0] == 'O') {
        file << fmt::format("{:.2f} 0.1 0\n", stamp_s);
      } else {
        file << fmt::format("{:.2f} {} 0 0\n", stamp_s, 0.01 * i);
      }
    }
  }
  std::ofstream(folder_.path() / "Barcodes.dat") << "1 5\n";
  std::ofstream(folder_.path() / "Landmark_Groundtruth.dat") << "";
  expect_told(run("{name: pose, driver: utias_mocap, params: {folder: " + folder_.path().string() +
                  ", robot: 1}}"),
              "sensor `pose` of robot `it` lost 50 of 100 readings (50.0 %): duplicate_stamp");
}

TEST_F(StreamLoss, OfARecordWhoseStampsStepBackIsTold) {
  record::RunInfo info;
  info.scenario = "source";
  info.step_s = 0.01;
  info.robots = {{RobotId(0), "source", "real", ""}};
  record::RecordedSensor pose;
  pose.robot = RobotId(0);
  pose.sensor = DeviceId(0);
  pose.name = "pose";
  pose.kind = static_cast<std::uint32_t>(ReadingKind::kPose);
  info.sensors = {pose};
  auto recorder = record::RunRecorder::open(folder_.path() / "source.mcap", info);
  ASSERT_TRUE(recorder) << recorder.error().text();
  for (std::uint32_t step = 0; step < 100; ++step) {
    const SimTime time{std::int64_t{step} * 10'000'000};
    recorder->begin_step(step, time);
    const PoseReading reading{0.01 * step, 0, 0, 0, 0};
    // Each fourth one is older than the one before.
    const std::int64_t late_ns = step % 4 == 3 ? 15'000'000 : 0;
    recorder->percept({RobotId(0),
                       DeviceId(0),
                       static_cast<std::uint8_t>(ReadingKind::kPose),
                       record::PerceptPart::kResult,
                       {time.ns - late_ns, step + 1, 1, 1, 0},
                       std::as_bytes(std::span(&reading, 1))});
    ASSERT_TRUE(recorder->end_step());
  }
  ASSERT_TRUE(recorder->end(std::nullopt));
  expect_told(
      run("{name: pose, driver: playback_pose, params: {file: " + folder_.path().string() +
          "/source.mcap, robot: source, "
          "sensor: pose}}"),
      "sensor `pose` of robot `it` lost 25 of 100 readings (25.0 %): stamps that step back");
}

}  // namespace
}  // namespace rave::cli_test
