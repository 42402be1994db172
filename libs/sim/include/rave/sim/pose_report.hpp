// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/ids.hpp"
#include "rave/sim/reported_pose.hpp"

namespace rave::sim {

/// The reported pose of a robot with a pose source (RobotType::pose_from) at the beginning of a
/// step, before it senses. A real robot is placed there with that velocity; it is in the world from
/// the first known pose on.
struct PoseReport {
  RobotId robot;
  ReportedPose reported;
};

/// One sample of a robot's pose source. The virtual halves of hybrid sensors use them to find where
/// real robots were at the stamp of a scan.
struct PoseSample {
  RobotId robot;
  SimTime stamp;  ///< Not after the step, and later than the robot's last one.
  Pose2 X_WR;
};

}  // namespace rave::sim
