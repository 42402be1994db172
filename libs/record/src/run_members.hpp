// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "packed.hpp"
#include "rave/math/pose.hpp"
#include "rave/record/cdr_archive.hpp"
#include "rave/record/run_messages.hpp"

namespace rave::record {

/// The members of messages without packed arrays, in the layouts that ros_schemas.cpp describes.
template <class Archive>
struct RunMembers {
  Archive& archive;

  void of(Pose2& v) { archive(v.x, v.y, v.yaw); }
  void of(PoseVariance& v) { archive(v.robot, v.xy_m2, v.yaw_rad2); }
  void of(RunEvent& v) { archive(v.robot, v.kind, v.text, v.values); }
  void of(ShadowRecord& v) { archive(v.robot, v.X_WR, v.X_WS, v.m, v.rad, v.readings); }
  void of(RunInput& v) {
    archive(v.step, v.kind, v.robot, v.key, v.value);
    archive.newer(v.by);
  }
  void of(RunChat& v) { archive(v.step, v.number, v.from, v.role, v.to, v.name, v.text); }
  void of(RecordedRobot& v) { archive(v.id, v.name, v.kind, v.team); }
  void of(RecordedSensor& v) {
    archive(v.robot, v.sensor, v.name, v.kind, v.X_RS, v.z_m, v.period_s, v.range_min_m,
            v.range_max_m, v.cone_rad, v.bearings_rad);
  }
  void of(RunInfo& v) {
    archive(v.scenario, v.started, v.seed, v.step_s, v.versions, v.robots, v.sensors);
    // A list of its own, because only the end of a message can have a newer member.
    std::vector<std::uint8_t> are_virtual;
    for (const RecordedSensor& sensor : v.sensors) are_virtual.push_back(sensor.is_virtual ? 1 : 0);
    archive.newer(are_virtual);
    const std::size_t known = std::min(are_virtual.size(), v.sensors.size());
    for (std::size_t i = 0; i < known; ++i) v.sensors[i].is_virtual = are_virtual[i] != 0;
  }
};

}  // namespace rave::record
