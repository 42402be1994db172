// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/raw_node.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// The robot of a name. Error: kNotFound with the nearest name.
[[nodiscard]] Result<RobotId> find_robot(const sim::EngineSpec& spec, std::string_view name);

/// A change as people write it: `program.PARAM`, `controller.NAME.PARAM`, `actuator.NAME.PARAM` or
/// `body.scale`, and the value as it would stand in a file. Errors: kNotFound with the nearest
/// name, kInvalidArgument; at the place of the value if it has one.
[[nodiscard]] Result<sim::ParameterChange> parse_change(const sim::RobotType& type,
                                                        std::string_view key,
                                                        const config::RawNode& value);

/// All keys that parse_change takes for a robot of this type.
[[nodiscard]] std::vector<std::string> parameter_keys(const sim::RobotType& type);

/// A parameter that parse_change takes, as its driver describes it.
struct ChangeableParameter {
  std::string key;
  const ParamSpec* spec = nullptr;  ///< Of the plug-in, which stays loaded as long as the type.
};
[[nodiscard]] std::vector<ChangeableParameter> changeable_parameters(const sim::RobotType& type);

/// The values of these parameters as text, by key: those that the files give to each robot of this
/// type.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> first_values(
    const sim::RobotType& type);
/// The same of one robot that `engine` runs, as they are now.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> present_values(
    const sim::Engine& engine, RobotId robot);

}  // namespace rave::runtime
