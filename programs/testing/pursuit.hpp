// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "programs/testing/room.hpp"

namespace rave::testing {

/// Gives `rig` what its neighbour sensor says of `other`, whose velocity is that of its last
/// command.
inline void see(Rig& rig, const Rig& other, std::uint32_t other_id, SimTime now) {
  for (RigSensor& sensor : rig.sensors) {
    if (sensor.info.kind != ReadingKind::kNeighbours) continue;
    const Pose2 X_WS = compose({rig.pose.x_m, rig.pose.y_m, rig.pose.yaw_rad}, sensor.info.X_RS);
    const Vec2 p_S = transform_back(X_WS, {other.pose.x_m, other.pose.y_m});
    const Vec2 v_S = rotate(other.pose.yaw_rad - X_WS.yaw, {other.commands.front().value[0], 0});
    NeighbourReading reading;
    reading.robot = other_id;
    reading.range_m = static_cast<float>(std::sqrt(squared_norm(p_S)));
    reading.bearing_rad = static_cast<float>(atan2(p_S.y, p_S.x));
    reading.vx_mps = static_cast<float>(v_S.x);
    reading.vy_mps = static_cast<float>(v_S.y);
    sensor.give<NeighbourReading>({reading}, now.ns);
  }
}

inline double distance_m(const Rig& a, const Rig& b) {
  return std::sqrt(squared_norm({a.pose.x_m - b.pose.x_m, a.pose.y_m - b.pose.y_m}));
}

}  // namespace rave::testing
