// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "message_checks.hpp"
#include "rave/base/hash.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/host_report.hpp"

namespace rave::sim {

/// What an engine that is one of several hosts has beyond one that is alone.
struct HostPart : HostRobots {
  /// `local`: by robot, 1 if it runs here.
  HostPart(const EngineSpec& spec, const std::vector<std::uint8_t>& local) {
    for (std::uint32_t r = 0; r < local.size(); ++r) {
      const RobotType& type = spec.types[spec.robots[r].type];
      if (local[r] == 0) continue;
      robots.emplace_back(r);
      if (type.simulated) simulated.emplace_back(r);
      if (type.pose_from) told.emplace_back(r);
    }
  }

  void begin() {
    begun = false;
    proposed = false;
    hash = RunHash();
    events.clear();
    reported_at_sending.clear();
    sent.clear();
    samples.clear();
    refusals.clear();
    obstacle_changes = 0;
  }

  std::vector<RobotId> robots;  ///< That run here, ascending.

  bool begun = false;     ///< A step has begun with apply() and is not done yet.
  bool proposed = false;  ///< The authority has been told; its answer comes next.
  // Of the steps that are done. What comes in early for the next one is not part of it yet.
  RunHash hash;
  std::vector<Event> events;
  /// By robot, those that run here: as they were when the messages of the step left.
  std::vector<ReportedPose> reported_at_sending;
  SentPackets sent;                    ///< Of the step.
  std::vector<PoseSample> samples;     ///< Since the last report.
  std::vector<InputRefusal> refusals;  ///< The same.
  /// How many changes of obstacles led to those that are here.
  std::uint64_t obstacle_changes = 0;
};

}  // namespace rave::sim
