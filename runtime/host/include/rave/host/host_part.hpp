// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::runtime {

/// The part of a scenario that one host runs, whichever process serves it.
struct HostPart {
  std::uint32_t number = 0;
  std::vector<RobotId> robots;
};

/// Error kNotFound: the scenario has no hosts, or none of this name.
[[nodiscard]] Result<HostPart> find_host_part(const config::ExpandedScenario& scenario,
                                              const std::string& name);

/// What the world says of obstacles in its step; an engine that is one of several hosts has no
/// events of them.
[[nodiscard]] std::vector<sim::Event> obstacle_events(const sim::WorldStep& world);

}  // namespace rave::runtime
