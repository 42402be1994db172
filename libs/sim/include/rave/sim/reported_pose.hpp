// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/robot/reading.hpp"

namespace rave::sim {

/// The pose of a robot according to its pose source.
struct ReportedPose {
  PoseReading pose;  ///< In W.
  Twist2 velocity;   ///< Body frame.
  SimTime stamp;
  bool known = false;  ///< False before the first pose.
  bool stale = false;
};

}  // namespace rave::sim
