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

/// Shows the robots whose file says `ros2: true` to ROS 2, with one participant for all of them:
/// their readings, transforms, description, and the time of the run, which all stamps are of. One
/// of several hosts shows its own robots, and the time if the first of all robots that are shown is
/// among them: a clock must have one writer, and so all hosts agree on it without a word.
/// docs/reference/ros2.md has the table of topics.
class Ros2Face final : public RunObserver {
 public:
  /// Null if no robot of this process wants it. `host`: its name, empty if it is alone. Errors:
  /// those of ros2::Participant::open().
  [[nodiscard]] static Result<std::unique_ptr<Ros2Face>> open(
      const config::ExpandedScenario& scenario, const sim::Engine& engine,
      const std::string& host = {});

  void after_step(const StepView& step) override;

 private:
  using AnyWriter = std::variant<ros2::Writer<ros2::LaserScan>, ros2::Writer<ros2::Range>,
                                 ros2::Writer<ros2::Odometry>, ros2::Writer<ros2::Imu>,
                                 ros2::Writer<ros2::BatteryState>, ros2::Writer<ros2::NavSatFix>>;

  struct Sensor {
    std::uint32_t index = 0;    ///< Of the robot's type.
    std::uint32_t written = 0;  ///< Sequence of the newest sample that has gone out.
    Ros2Reading reading;
    AnyWriter writer;
    Pose2 X_WM;  ///< Of poses: the frame that they are in.
  };
  struct Robot {
    RobotId id;
    std::string prefix;  ///< Of its frames: its name and a slash.
    std::string odom_frame;
    std::string base_frame;
    std::vector<Sensor> sensors;
    std::optional<std::uint32_t> odometry;  ///< The first sensor of that kind.
    Ros2Reading own;  ///< Odometry out of its reported pose, if it has no such sensor.
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
  std::optional<GeoFrame> earth_;                   ///< Unset: nobody knows where the world lies.
  std::optional<ros2::Writer<ros2::Clock>> clock_;  ///< Unset: another host has the time.
  std::optional<ros2::Writer<ros2::TfMessage>> tf_;
  std::optional<ros2::Writer<ros2::TfMessage>> tf_static_;
  std::vector<Robot> robots_;
  std::string map_frame_ = "map";
  std::int64_t period_ns_ = 0;
  std::int64_t due_ns_ = 0;
};

}  // namespace rave::runtime
