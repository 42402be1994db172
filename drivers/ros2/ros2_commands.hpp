// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros2/topic_sensor.hpp"

/// Commands of other nodes to a robot of this run, as sensors: its program decides what to do with
/// them. Silence is not a failure, and no sender needs to be present at the start.
namespace rave::ros2_driver {

/// Velocity commands, as Twist or TwistStamped.
class Ros2Command final : public TopicSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kVelocity;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  void look_after(TopicState& state) override;
  [[nodiscard]] std::string explain_silence() const override;
  [[nodiscard]] std::vector<dds_entity_t> readers() const override;
  [[nodiscard]] const std::string& topic() const override;
  void take(const ros2::Twist& twist, std::int64_t stamp_ns);

  // Exactly one of the two is set.
  std::optional<ros2::Reader<ros2::Twist>> plain_;
  std::optional<ros2::Reader<ros2::TwistStamped>> stamped_;
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
