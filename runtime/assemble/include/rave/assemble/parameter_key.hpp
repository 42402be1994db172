// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/codec/raw_node.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// The robot with this name. Error: kNotFound with the nearest name.
[[nodiscard]] Result<RobotId> find_robot(const sim::EngineSpec& spec, std::string_view name);

/// Parses a change: `program.PARAM`, `controller.NAME.PARAM`, `actuator.NAME.PARAM` or
/// `body.scale`, and the value as in a file. Errors: kNotFound with the nearest name,
/// kInvalidArgument; with the place of the value if it has one.
[[nodiscard]] Result<sim::ParameterChange> parse_change(const sim::RobotType& type,
                                                        std::string_view key,
                                                        const codec::RawNode& value);

/// A parameter that parse_change() accepts, with the description of its driver.
struct ChangeableParameter {
  std::string key;
  /// Part of the plug-in, which stays loaded as long as the type.
  const ParamSpec* spec = nullptr;
};
[[nodiscard]] std::vector<ChangeableParameter> changeable_parameters(const sim::RobotType& type);

/// The initial values of these parameters as text, by key; equal for all robots of this type.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> first_values(
    const sim::RobotType& type);

/// The values that the run has changed, as text by key; nothing of a robot of another host.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> changed_values(
    const sim::Engine& engine, RobotId robot);

}  // namespace rave::runtime
