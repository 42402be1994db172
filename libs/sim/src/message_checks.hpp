// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_step.hpp"

/// Whether what came from another process can be used. Nothing is taken from a message that has not
/// been through here. Errors: kInvalidArgument, with the reason.
namespace rave::sim {

/// The robots of one host, ascending.
struct HostRobots {
  std::vector<RobotId> simulated;
  std::vector<RobotId> told;  ///< Something says where they are.

  /// A robot of this host has such drivers from now on.
  void set_type(RobotId robot, const RobotType& type);
};

/// A report for `step` of the host that runs `own`; whether its number and step are right has been
/// seen before. `host_of`: by robot.
Status check_report(const EngineSpec& spec, const HostRobots& own,
                    std::span<const std::uint32_t> host_of, const HostReport& report);

/// The same of the authority's message.
Status check_world_step(const EngineSpec& spec, const WorldStep& world);

/// The same for a state that a process takes over that was not present before. `needs_obstacles`:
/// those of the state have to lead from the start to the world; otherwise neither they nor those of
/// the world are looked at.
Status check_taken_over(const EngineSpec& spec, const WorldStep& world, const AuthorityState& state,
                        bool needs_obstacles);

/// The part of it that concerns obstacles: those of `state` lead from the start to those before
/// `world`.
Status check_told_obstacles(const EngineSpec& spec, const WorldStep& world,
                            const AuthorityState& state);

}  // namespace rave::sim
