// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/protocol/host_link.hpp"

namespace rave::runtime {

/// Robots with two sets of drivers in a run in real time over several hosts: a hand-over is the
/// matter of the engine that runs the robot, and all others receive what the robot is now. Belongs
/// to one thread.
class LiveTwins {
 public:
  /// `engine`: that of this host, before its first step.
  LiveTwins(const sim::Engine& engine, std::span<const RobotId> own);

  /// Between propose() of the engine and the step of the world: what has changed here is the
  /// world's, too, and what others say is the engine's. Errors: those of LiveWorld::serve().
  Status follow(sim::Engine& engine, real_time::LiveWorld& live, real_time::HostLink& link);

 private:
  struct Own {
    RobotId robot;
    std::uint32_t type = 0;  ///< That the world knows of.
  };
  std::vector<RobotId> local_;  ///< All robots of this host.
  std::vector<Own> own_;        ///< Those of them that have two sets.
};

/// By robot, the number of its host, if a robot of the run has two sets of drivers; else nothing.
/// Errors: those of config::plan_hosts().
[[nodiscard]] Result<std::vector<std::uint32_t>> hosts_of_twins(
    const config::ExpandedScenario& scenario, const sim::EngineSpec& spec);

}  // namespace rave::runtime
