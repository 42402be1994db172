// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/plugin/params.hpp"

namespace rave::sim {

/// A new value of a parameter: 0 or 1 for a flag, the text for a text or choice.
using ParameterValue = std::variant<double, std::string, std::vector<double>>;
/// The value as written in a file.
[[nodiscard]] std::string to_string(const ParameterValue& value);

/// A new value for one parameter of a running robot.
struct ParameterChange {
  enum class Part : std::uint8_t { kProgram, kController, kActuator, kBody };
  Part part = Part::kProgram;
  std::uint32_t index = 0;  ///< Index of the controller or actuator in its RobotType.
  std::string name;
  ParameterValue value;
};

/// The parameters of a simulated robot's body: `scale` scales its outline about the robot's origin,
/// 1 as in its file. Heights, mountings of sensors and actuators do not change.
[[nodiscard]] std::span<const ParamSpec> body_params() noexcept;

/// A change that is part of the run. It is made before step `step` senses.
struct ScheduledChange {
  std::uint64_t step = 0;
  RobotId robot;
  std::vector<ParameterChange> changes;  ///< Applied all or none.
};

}  // namespace rave::sim
