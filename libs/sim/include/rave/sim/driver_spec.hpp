// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/error.hpp"
#include "rave/plugin/param_set.hpp"

namespace rave::sim {

/// What all parts of a robot type that a driver serves have in common.
struct DriverSpec {
  std::string name;
  std::string driver;
  plugin::ParamSet params;
  SourceLocation where{};  ///< Of its driver in the robot file, for errors.
};

}  // namespace rave::sim
