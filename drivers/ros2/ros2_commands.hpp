// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros2/topic_sensor.hpp"

/// Commands of other nodes to a robot of this run, as sensors: its program decides what to do with
/// them. Silence is not a failure, and no sender needs to be present at the start.
namespace rave::ros2_driver {

/// Velocity commands, as Twist or TwistStamped.
class Ros2Command final : public TwoTopicSensor<ros2::Twist, ros2::TwistStamped> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kVelocity;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  void take(const ros2::Twist& twist);
};

/// Goal poses, in the frame of the message.
class Ros2Goal final : public OneTopicSensor<ros2::PoseStamped> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::PoseStamped& message) override;
};

}  // namespace rave::ros2_driver
