// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/ros2/writer.hpp"
#include "rave/ros2_bridge/ros2_messages.hpp"

namespace rave::runtime {

/// Publishes the robots with `ros2: true` to ROS 2, with one participant for all of them: readings,
/// transforms, description, and the time of the run, which all stamps refer to. One of several
/// hosts publishes its own robots. /clock must have one writer: the host of the first published
/// robot, which every host can determine without communication. docs/reference/ros2.md lists the
/// topics.
class Ros2Face final : public RunObserver {
 public:
  /// Returns null if no robot of this process has `ros2: true`. `host`: its name, empty if it is
  /// alone. Errors: those of ros2::Participant::open().
  [[nodiscard]] static Result<std::unique_ptr<Ros2Face>> open(
      const config::ExpandedScenario& scenario, const sim::Engine& engine,
      const std::string& host = {});

  void after_step(const StepView& step) override;

 private:
  using AnyWriter = std::variant<ros2::Writer<ros2::LaserScan>, ros2::Writer<ros2::Range>,
                                 ros2::Writer<ros2::Odometry>, ros2::Writer<ros2::Imu>,
                                 ros2::Writer<ros2::BatteryState>, ros2::Writer<ros2::NavSatFix>>;

  struct Sensor {
    std::uint32_t index = 0;    ///< Index in the robot's type.
    std::uint32_t written = 0;  ///< Sequence of the last published sample.
    Ros2Reading reading;
    AnyWriter writer;
    Pose2 X_WM;  ///< For poses: their frame M.
  };
  struct Robot {
    RobotId id;
    std::string prefix;  ///< Prefix of its frames: its name and a slash.
    std::string odom_frame;
    std::string base_frame;
    std::vector<Sensor> sensors;
    std::optional<std::uint32_t> odometry;  ///< Index of the first odometry sensor.
    Ros2Reading own;  ///< Odometry from its reported pose, if it has no such sensor.
    std::optional<ros2::Writer<ros2::Odometry>> own_writer;
    std::optional<ros2::Writer<ros2::String>> description;
  };

  explicit Ros2Face(std::unique_ptr<ros2::Participant> participant)
      : participant_(std::move(participant)) {}
  [[nodiscard]] Status add(const sim::Engine& engine, RobotId id);
  [[nodiscard]] Status add_sensors(const sim::Engine& engine, Robot& robot);
  [[nodiscard]] Result<AnyWriter> writer_for(Ros2Kind kind, const std::string& topic) const;
  [[nodiscard]] Status begin(const sim::Engine& engine, bool keeps_time);
  void write_new(const sim::Engine& engine, Robot& robot);
  void write_static(const sim::Engine& engine);
  void write_sensor(Sensor& sensor, const sim::SensorSample& sample) const;
  void write_transforms(const sim::Engine& engine);

  std::unique_ptr<ros2::Participant> participant_;
  std::optional<GeoFrame> earth_;  ///< Empty: the position on the earth is unknown.
  std::optional<ros2::Writer<ros2::Clock>> clock_;  ///< Empty: another host publishes the time.
  std::optional<ros2::Writer<ros2::TfMessage>> tf_;
  std::optional<ros2::Writer<ros2::TfMessage>> tf_static_;
  std::vector<Robot> robots_;
  std::string map_frame_ = "map";
  std::int64_t period_ns_ = 0;
  std::int64_t due_ns_ = 0;
};

}  // namespace rave::runtime
