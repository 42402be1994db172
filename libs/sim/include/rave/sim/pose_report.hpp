// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/ids.hpp"
#include "rave/sim/reported_pose.hpp"

namespace rave::sim {

/// Where a robot that has a source of its pose (RobotType::pose_from) is reported at the beginning
/// of a step, before that step senses. A real robot is put there, with that velocity, and is in the
/// world as soon as the pose is known.
struct PoseReport {
  RobotId robot;
  ReportedPose reported;
};

/// One sample of a robot's pose source that came with the step. The virtual halves of hybrid
/// sensors look up in these where real robots were at the stamp of a scan.
struct PoseSample {
  RobotId robot;
  SimTime stamp;  ///< Not after the step; each later than the robot's last one.
  Pose2 X_WR;
};

}  // namespace rave::sim
