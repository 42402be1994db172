// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "rave/config/params.hpp"
#include "rave/robot_host/build.hpp"

namespace rave::robot_host {

/// What is needed to turn the devices of one robot file into those of a robot type.
struct DeviceContext {
  const config::ExpandedScenario& scenario;
  plugin::Catalogue& catalogue;
  const BuildOptions& options;
  BuiltScenario& built;
};

/// The description of a driver's parameters in the terms of the configuration library.
[[nodiscard]] std::vector<config::FieldSpec> field_specs(const DriverInfo& info);

/// The driver of one of `kinds`; errors point at its name in the file.
[[nodiscard]] Result<const plugin::Driver*> find_driver(const DeviceContext& context,
                                                        std::span<const DriverKind> kinds,
                                                        const config::Located<std::string>& name);

/// The parameters of a driver, checked, defaults filled in.
[[nodiscard]] Result<plugin::ParamSet> read_params(const plugin::Driver& driver,
                                                   const config::RawNode& params);

/// Notes the first driver that runs by the clock on the wall; `device` is its name in the file.
void note_clock(const DeviceContext& context, const config::RobotGroup& group,
                const std::string& device, const DriverInfo& info, const plugin::ParamSet& params);

/// Fills in transmitters and communicators of `type`. In radio_devices.cpp.
Status add_radio(const DeviceContext& context, const config::RobotGroup& group,
                 sim::RobotType& type);

/// Fills in sensors, actuators, controllers, program and pose source of `type`.
Status add_devices(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type);

}  // namespace rave::robot_host
