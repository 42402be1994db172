// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "ros2/readings.hpp"
#include "ros2/tf_tree.hpp"
#include "ros2/topic_sensor.hpp"

/// One class for each kind of message that a robot's sensor can be made of.
namespace rave::ros2_driver {

/// The first scan says how many rays there are and where they go; others are refused.
class Ros2Laser final : public OneTopicSensor<ros2::LaserScan> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::LaserScan& message) override;

  Fan fan_;
  std::vector<double> bearings_rad_;
  std::vector<float> ranges_m_;
};

class Ros2Range final : public OneTopicSensor<ros2::RangeReading> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::RangeReading& message) override;

  double bearing_rad_ = 0;
};

class Ros2Odometry final : public OneTopicSensor<ros2::Odometry> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kOdometry;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::Odometry& message) override;

  Doubt doubt_;
};

/// The pose that a motion capture or a localisation writes.
class Ros2Pose final : public OneTopicSensor<ros2::PoseStamped> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::PoseStamped& message) override;

  Doubt doubt_;
};

/// The pose out of odometry, for robots that have nothing better.
class Ros2OdometryPose final : public OneTopicSensor<ros2::Odometry> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::Odometry& message) override;

  Doubt doubt_;
};

/// The pose as the chain of transforms from the map to the robot's body.
class Ros2TfPose final : public TopicSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  void look_after(TopicState& state) override;
  [[nodiscard]] std::string explain_silence() const override;
  [[nodiscard]] const std::string& topic() const override { return moving_->topic(); }
  [[nodiscard]] std::vector<dds_entity_t> readers() const override {
    return {moving_->handle(), static_->handle()};
  }
  void add(ros2::Reader<ros2::TfMessage>& reader, bool is_static);
  [[nodiscard]] Status await_chain();

  std::string map_frame_;
  std::string base_frame_;
  Doubt doubt_;
  std::optional<ros2::Reader<ros2::TfMessage>> moving_;
  std::optional<ros2::Reader<ros2::TfMessage>> static_;
  TfTree tree_;
  std::int64_t newest_ns_ = 0;
};

/// Ten values: orientation x, y, z, w; rate of turn about x, y, z (rad/s); acceleration along them
/// (m/s^2, gravity included). NaN: not measured.
class Ros2Imu final : public OneTopicSensor<ros2::Imu> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::Imu& message) override;
};

/// Six values: charge 0 to 1, V, A (negative: discharging), Ah, Ah of capacity, degrees Celsius.
/// NaN: not measured.
class Ros2Battery final : public OneTopicSensor<ros2::BatteryState> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::BatteryState& message) override;
};

}  // namespace rave::ros2_driver
