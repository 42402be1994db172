// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ros2/gps_track.hpp"
#include "ros2/topic_sensor.hpp"

namespace rave::ros2_driver {

/// The pose of a robot from satellite navigation, with the heading of an inertial unit or of its
/// travel. Without a fix the sensor is alive but gives no pose, so the pose becomes stale.
class Ros2Gps final : public TwoTopicSensor<ros2::NavSatFix, ros2::Imu> {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;

 private:
  Status prepare(const Params& params, HardwareDeclaration& declaration) override;
  void drain() override;
  bool counts(std::uint64_t writer);
  bool counts_beside(std::uint64_t writer);
  bool hear(const ros2::Imu& message);
  void hear_imu();
  [[nodiscard]] std::optional<PoseReading> pose_of(const ros2::NavSatFix& fix);

  std::optional<GpsTrack> track_;
  WriterChoice fixes_;
  WriterChoice orientations_;
};

}  // namespace rave::ros2_driver
