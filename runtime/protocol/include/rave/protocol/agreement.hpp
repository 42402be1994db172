// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/config/expanded_scenario.hpp"

namespace rave::runtime {

/// A number of what the processes of a run must agree on: of all that the scenario says but its
/// pace, its threads and what to do about lost hosts.
[[nodiscard]] std::uint64_t shared_number(const config::ExpandedScenario& scenario);

/// What else they must have in common: the interface of plug-ins.
[[nodiscard]] std::uint64_t interface_stamp();

}  // namespace rave::runtime
