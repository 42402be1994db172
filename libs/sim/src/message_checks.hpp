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
};

/// A report for `step` of the host that runs `own`; whether its number and step are right has been
/// seen before. `host_of`: by robot.
Status check_report(const EngineSpec& spec, const HostRobots& own,
                    std::span<const std::uint32_t> host_of, const HostReport& report);

/// The same of the authority's message.
Status check_world_step(const EngineSpec& spec, const WorldStep& world);

/// The same of what somebody takes over who was not there before: the obstacles of the world are
/// left out, since they follow those of the state.
Status check_taken_over(const EngineSpec& spec, const WorldStep& world,
                        const AuthorityState& state);

}  // namespace rave::sim
