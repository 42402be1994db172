// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros2/gps_track.hpp"
#include "ros2/topic_sensor.hpp"

namespace rave::ros2_driver {

/// The pose of a robot out of its satellite navigation, with the heading of an inertial unit or of
/// its way. A receiver without a fix is there but gives no pose, which grows stale.
class Ros2Gps final : public TopicSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  void look_after(TopicState& state) override;
  [[nodiscard]] std::string explain_silence() const override { return fixes_->explain_silence(); }
  [[nodiscard]] std::vector<dds_entity_t> readers() const override;
  [[nodiscard]] const std::string& topic() const override { return fixes_->topic(); }
  bool hear(const ros2::Imu& message);
  void hear_imu();
  [[nodiscard]] std::optional<PoseReading> pose_of(const ros2::NavSatFix& fix);

  std::optional<GpsTrack> track_;
  std::optional<ros2::Reader<ros2::NavSatFix>> fixes_;
  std::optional<ros2::Reader<ros2::Imu>> imu_;
};

}  // namespace rave::ros2_driver
