// SPDX-License-Identifier: Apache-2.0
#include "recording/samples.hpp"

#include "recording/pose_track.hpp"

namespace rave::recording {

void wrap_heading(Pose2& pose, int line, StreamReport& report) {
  const double wrapped = wrap_angle(pose.yaw);
  if (wrapped == pose.yaw) return;
  add_repair(report.repairs, RepairKind::kHeadingWrapped, 1, line);
  pose.yaw = wrapped;
}

}  // namespace rave::recording
