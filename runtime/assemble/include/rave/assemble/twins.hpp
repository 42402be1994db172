// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// A group with the second set of drivers of a robot with `twin:`.
[[nodiscard]] config::RobotGroup twin_group(const config::RobotGroup& group);
/// The type for the robots of a group. Errors: those of add_devices() and guard_spec().
[[nodiscard]] Result<sim::RobotType> make_type(const DeviceContext& context,
                                               const config::RobotGroup& group);

/// Adds the second type of robots with `twin:`, after all robots are in the spec. Errors name the
/// differences of the two files that are not permitted.
Status add_twins(const DeviceContext& context);

/// Adds the hand-overs in `changes:` of the scenario. Errors: kInvalidArgument (both sets of a
/// robot are real, or both are simulated).
Status add_hand_overs(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

/// The set of drivers that a word refers to; `active`: the present set. Errors: kInvalidArgument
/// (the robot has one set; both or neither of them fit the word).
[[nodiscard]] Result<sim::DriverSet> driver_set(const sim::EngineSpec& spec, RobotId robot,
                                                sim::DriverSet active, config::HandOverTo to);
/// Parses `real`, `simulated`, `first` or `twin`. Errors: kInvalidArgument, with the nearest of
/// them.
[[nodiscard]] Result<config::HandOverTo> hand_over_word(std::string_view word);

}  // namespace rave::runtime
