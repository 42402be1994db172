// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rave/ros2/convert.hpp"
#include "ros2/readings.hpp"
#include "ros2/tf_tree.hpp"
#include "ros2/topic_sensor.hpp"

/// One class per kind of message for sensors of a robot.
namespace rave::ros2_driver {

/// The first scan defines the rays, on which later ones are put.
class Ros2Laser final : public OneTopicSensor<ros2::LaserScan> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::LaserScan& message) override;

  Fan fan_;
  Zero zero_ = Zero::kNoReading;
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

/// A message with one reading. Parameters give the uncertainty if the message has none.
template <ReadingKind kKind, class Message, class Reading,
          Result<Reading> (*kConvert)(const Message&, const Doubt&)>
class Ros2State final : public OneTopicSensor<Message> {
 public:
  static constexpr ReadingKind kReading = kKind;

 private:
  Status prepare(const Params& params, HardwareDeclaration& /*declaration*/) override {
    doubt_ = read_doubt(params);
    return this->begin_reading(params);
  }
  Status take(const Message& message) override {
    RAVE_TRY_ASSIGN(const Reading reading, kConvert(message, doubt_));
    this->publish(ros2::nanoseconds(message.header.stamp), &reading, 1);
    return {};
  }

  Doubt doubt_;
};

using Ros2Odometry =
    Ros2State<ReadingKind::kOdometry, ros2::Odometry, OdometryReading, odometry_of>;
/// The pose from motion capture or localisation.
using Ros2Pose = Ros2State<ReadingKind::kPose, ros2::PoseStamped, PoseReading, pose_of>;
/// The pose from odometry, for robots without a better source.
using Ros2OdometryPose = Ros2State<ReadingKind::kPose, ros2::Odometry, PoseReading, pose_of>;

/// A message with a fixed number of values.
template <class Message, std::size_t kCount,
          std::array<double, kCount> (*kConvert)(const Message&) noexcept>
class Ros2Values final : public OneTopicSensor<Message> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override {
    declaration.capacity = kCount;
    return this->begin_reading(params);
  }
  Status take(const Message& message) override {
    const auto values = kConvert(message);
    this->publish(ros2::nanoseconds(message.header.stamp), values.data(), kCount);
    return {};
  }
};

/// Ten values: orientation x, y, z, w; rate of turn about x, y, z (rad/s); acceleration along them
/// (m/s^2, gravity included). NaN: not measured.
using Ros2Imu = Ros2Values<ros2::Imu, 10, imu_values>;
/// Six values: charge 0 to 1, V, A (negative: discharging), Ah, Ah of capacity, degrees Celsius.
/// NaN: not measured.
using Ros2Battery = Ros2Values<ros2::BatteryState, 6, battery_values>;

/// The pose from the chain of transforms from the map to the robot's body. Static transforms are on
/// a separate topic.
class Ros2TfPose final : public TwoTopicSensor<ros2::TfMessage, ros2::TfMessage> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  [[nodiscard]] std::string explain_silence() const override;
  /// False: an error of it is noted, or no transform of it counts.
  bool add(ros2::Reader<ros2::TfMessage>& reader, const ros2::TfMessage& message,
           dds_instance_handle_t writer, bool is_static);
  void add_static();
  [[nodiscard]] Status await_chain();

  std::string map_frame_;
  std::string base_frame_;
  Doubt doubt_;
  TfTree tree_;
  std::map<std::string, WriterChoice, std::less<>> writers_;  ///< By child, of the robot's chain.
  std::int64_t last_ns_ = 0;                                  // stamp of the last pose
};

}  // namespace rave::ros2_driver
