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

/// A new value of a parameter: of a flag 0 or 1, of a text or choice the text.
using ParameterValue = std::variant<double, std::string, std::vector<double>>;
/// As a person would write it.
[[nodiscard]] std::string to_string(const ParameterValue& value);

/// One parameter of a robot that runs, and what it becomes.
struct ParameterChange {
  enum class Part : std::uint8_t { kProgram, kController, kActuator, kBody };
  Part part = Part::kProgram;
  std::uint32_t index = 0;  ///< Of the controller or actuator in its RobotType.
  std::string name;
  ParameterValue value;
};

/// What the body of a simulated robot takes: `scale`, of its outline about the robot's origin, 1 as
/// in its file. Heights, mountings of sensors and what drives it stay as they are.
[[nodiscard]] std::span<const ParamSpec> body_params() noexcept;

/// A change that belongs to the run: made before the step `step` senses.
struct ScheduledChange {
  std::uint64_t step = 0;
  RobotId robot;
  std::vector<ParameterChange> changes;  ///< All of them, or none.
};

}  // namespace rave::sim
