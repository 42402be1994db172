// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/config/expanded_scenario.hpp"

namespace rave::runtime {

/// A hash of everything that the processes of a run must agree on: the scenario except its pace,
/// its threads and its policy for lost hosts.
[[nodiscard]] std::uint64_t shared_number(const config::ExpandedScenario& scenario);

/// A hash of the plug-in interface, on which they must agree too.
[[nodiscard]] std::uint64_t interface_stamp();

}  // namespace rave::runtime
