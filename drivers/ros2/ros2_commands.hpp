// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros2/topic_sensor.hpp"

/// What others want of a robot of ours, as sensors: its program decides what to do with it. Silence
/// is no failure, and nobody need be there when the run starts.
namespace rave::ros2_driver {

/// The velocity that somebody gives, as Twist or TwistStamped.
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

  // One of the two.
  std::optional<ros2::Reader<ros2::Twist>> plain_;
  std::optional<ros2::Reader<ros2::TwistStamped>> stamped_;
};

/// The pose that somebody sends it to, in the frame of the message.
class Ros2Goal final : public OneTopicSensor<ros2::PoseStamped> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  Status take(const ros2::PoseStamped& message) override;
};

}  // namespace rave::ros2_driver
