// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "rave/record/run_record.hpp"

namespace rave::record {

/// What a small run records: two robots, a laser, commands, radio, events, console.
struct SampleStep {
  std::vector<RobotPose> poses;
  std::vector<float> ranges;
  std::vector<std::byte> command;
};

[[nodiscard]] inline RunInfo sample_info() {
  RunInfo info;
  info.scenario = "sample";
  info.started = "2024-05-01T12:00:00Z";
  info.seed = 0xFFFFFFFFFFFFFFFFULL;
  info.step_s = 0.01;
  info.versions = {{"rave", "0.1.0"}, {"driver laser", "2"}};
  info.robots = {{RobotId(0), "anna", "simulated", "red"}, {RobotId(1), "bert", "real", ""}};
  RecordedSensor laser;
  laser.robot = RobotId(0);
  laser.sensor = DeviceId(2);
  laser.name = "laser";
  laser.kind = 1;
  laser.X_RS = {0.1, -0.2, 0.3};
  laser.z_m = 0.25;
  laser.period_s = 0.1;
  laser.range_min_m = 0.05;
  laser.range_max_m = 8;
  laser.bearings_rad = {-0.5, 0, 0.5};
  laser.is_virtual = true;
  info.sensors = {laser};
  info.inputs = {{"/maps/hall.pgm", "00ff"}};
  info.expanded_scenario = "name: sample\nrobots: [anna, bert]\n";
  return info;
}

[[nodiscard]] inline SampleStep sample_step(std::uint64_t step) {
  SampleStep sample;
  const double t = static_cast<double>(step);
  RobotPose anna{RobotId(0), Pose2{t / 3, -0.0, 0.1}, Pose2{t / 3, 0.0, 0.1}, {1, 2, -t}};
  RobotPose bert{RobotId(1), std::nullopt, Pose2{1e-300, t * t, -3.1}, {}};
  if (step % 2 == 1) anna.reported_pose = anna.true_pose;
  if (step == 0) bert.reported_pose.reset();
  sample.poses = {anna, bert};
  sample.ranges = {static_cast<float>(t) / 7, std::numeric_limits<float>::infinity(), 0.0F};
  const std::uint32_t head[2] = {1, 2};
  const double values[4] = {t / 9, -0.25, 0, 0};
  sample.command.resize(40);
  std::memcpy(sample.command.data(), head, 8);
  std::memcpy(sample.command.data() + 8, values, 32);
  return sample;
}

/// Records the whole sample; the recorder is left open.
inline void record_sample(RunRecorder& recorder, std::uint64_t steps) {
  for (std::uint64_t step = 0; step < steps; ++step) {
    const SampleStep sample = sample_step(step);
    const SimTime time{static_cast<std::int64_t>(step) * 10'000'000};
    recorder.begin_step(step, time);
    const auto ranges = std::as_bytes(std::span(sample.ranges));
    const ReadingHeader header{time.ns - 1, static_cast<std::uint32_t>(step) + 1, 3, 1, 0};
    recorder.percept({RobotId(0), DeviceId(2), 1, PerceptPart::kReal, header, ranges.first(8)});
    recorder.percept({RobotId(0), DeviceId(2), 1, PerceptPart::kResult, header, ranges});
    recorder.command({RobotId(1), DeviceId(0), sample.command});
    recorder.actuator({RobotId(1), DeviceId(0), sample.command});
    static_cast<void>(recorder.hash(step * 0x9e3779b97f4a7c15ULL));
    if (step % 3 == 0) {
      recorder.radio({RobotId(0), RobotId(1), 4, step != 0, time.ns - 5, time.ns,
                      std::as_bytes(std::span(&step, 1))});
    }
    if (step % 4 == 0) {
      static_cast<void>(
          recorder.event({RobotId(1), "contact", "bert touches a wall", {0.5, -0.0}}));
    }
    if (step % 5 == 0) recorder.console(LogLevel::kWarning, "robot anna", "low battery");
    recorder.poses(sample.poses);
    static_cast<void>(recorder.end_step());
  }
}

}  // namespace rave::record
