// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "rave/assemble/build.hpp"
#include "rave/config/params.hpp"

namespace rave::runtime {

/// The context for converting the devices of a robot file to those of a robot type.
struct DeviceContext {
  const config::ExpandedScenario& scenario;
  plugin::Catalogue& catalogue;
  const BuildOptions& options;
  BuiltScenario& built;
};

/// The description of one parameter for the configuration library. In driver_params.cpp.
[[nodiscard]] config::FieldSpec field_spec(const ParamSpec& spec);

/// The descriptions of a driver's parameters for the configuration library.
[[nodiscard]] std::vector<config::FieldSpec> field_specs(const DriverInfo& info);

/// The values of a driver's parameters, defaults filled in. Errors: with file, line and column.
[[nodiscard]] Result<plugin::ParamSet> read_params(const plugin::Driver& driver,
                                                   const codec::RawNode& params);

/// Adds transmitters and communicators to `type`. In radio_devices.cpp.
Status add_radio(const DeviceContext& context, const config::RobotGroup& group,
                 sim::RobotType& type);

/// Adds the program, if any, to `type`. In program_device.cpp.
Status add_program(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type);

/// Adds sensors, actuators, controllers, program and pose source to `type`.
Status add_devices(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type);

}  // namespace rave::runtime
