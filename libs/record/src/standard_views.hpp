// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>

#include "rave/record/cdr.hpp"
#include "rave/record/run_record.hpp"
#include "stream.hpp"

namespace rave::record {

/// Numbers of rave::ReadingKind and rave::CommandKind that have a standard message.
inline constexpr std::uint8_t kRangesKind = 1;
inline constexpr std::uint32_t kVelocityKind = 1;

/// Writes part of the recorded data a second time, as standard ROS 2 messages at a lower rate, for
/// viewers. RAVE does not read them back.
class StandardViews {
 public:
  [[nodiscard]] Status open(McapWriter& file, const RunInfo& info, const ViewOptions& options);
  [[nodiscard]] bool sees(RobotId robot) const noexcept { return robot.value() < robots_; }

  /// Whether poses() must be called in this step; counts as a call.
  [[nodiscard]] bool poses_due(SimTime time) noexcept {
    return period_ns_ != 0 && due(tf_, time, tf_period_ns_);
  }
  Status poses(McapWriter& file, SimTime time, std::span<const RobotPose> robots);
  Status percept(McapWriter& file, SimTime time, const Percept& percept);
  Status command(McapWriter& file, SimTime time, const CommandRecord& command);

 private:
  struct Paced {
    Stream stream;
    std::int64_t next_ns = std::numeric_limits<std::int64_t>::min();
  };
  struct Scan {
    Paced paced;
    std::string frame;
    float angle_min = 0, angle_max = 0, increment = 0, period = 0, range_min = 0, range_max = 0;
  };

  [[nodiscard]] static bool due(Paced& paced, SimTime time, std::int64_t period_ns) noexcept;
  [[nodiscard]] Status open_scans(McapWriter& file, const RunInfo& info);
  [[nodiscard]] Status open_velocities(McapWriter& file, const RunInfo& info);
  [[nodiscard]] Status write_mountings(McapWriter& file, const RunInfo& info);
  void put_transform(SimTime time, std::string_view parent, std::string_view child, const Pose2& X,
                     double z_m);

  std::int64_t period_ns_ = 0;
  std::int64_t tf_period_ns_ = 0;
  std::uint32_t robots_ = 0;
  std::vector<std::string> frames_;  ///< By robot.
  Paced tf_;
  std::map<std::pair<RobotId, DeviceId>, Scan> scans_;
  std::map<RobotId, Paced> velocities_;
  CdrWriter cdr_;
};

}  // namespace rave::record
