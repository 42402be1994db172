// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// The other drivers of a robot with `twin:`, as a group of their own.
[[nodiscard]] config::RobotGroup twin_group(const config::RobotGroup& group);
/// The type of the robots of a group. Errors: those of add_devices() and guard_spec().
[[nodiscard]] Result<sim::RobotType> make_type(const DeviceContext& context,
                                               const config::RobotGroup& group);

/// Gives robots with `twin:` their other type, once all robots are in the spec. Errors point at
/// what is different of the two files but must not be.
Status add_twins(const DeviceContext& context);

/// The hand-overs that the scenario lists under `changes:`. Errors: kInvalidArgument (both sets of
/// a robot are real, or both are simulated).
Status add_hand_overs(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

/// Which set of drivers a word stands for; `active`: the one that serves the robot now. Errors:
/// kInvalidArgument (the robot has one set; both or neither of them fit the word).
[[nodiscard]] Result<sim::DriverSet> driver_set(const sim::EngineSpec& spec, RobotId robot,
                                                sim::DriverSet active, config::HandOverTo to);
/// `real`, `simulated`, `first` or `twin`. Errors: kInvalidArgument, with the nearest of them.
[[nodiscard]] Result<config::HandOverTo> hand_over_word(std::string_view word);

}  // namespace rave::runtime
