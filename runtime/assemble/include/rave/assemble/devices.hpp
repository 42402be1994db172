// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "rave/assemble/build.hpp"
#include "rave/config/params.hpp"

namespace rave::runtime {

/// What is needed to turn the devices of one robot file into those of a robot type.
struct DeviceContext {
  const config::ExpandedScenario& scenario;
  plugin::Catalogue& catalogue;
  const BuildOptions& options;
  BuiltScenario& built;
};

/// The description of one parameter in the terms of the configuration library. In
/// driver_params.cpp.
[[nodiscard]] config::FieldSpec field_spec(const ParamSpec& spec);

/// The description of a driver's parameters in the terms of the configuration library.
[[nodiscard]] std::vector<config::FieldSpec> field_specs(const DriverInfo& info);

/// Fills in transmitters and communicators of `type`. In radio_devices.cpp.
Status add_radio(const DeviceContext& context, const config::RobotGroup& group,
                 sim::RobotType& type);

/// Fills in the program of `type`, if there is one. In program_device.cpp.
Status add_program(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type);

/// Fills in sensors, actuators, controllers, program and pose source of `type`.
Status add_devices(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type);

}  // namespace rave::runtime
