// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "devices.hpp"

// What the makers of devices share.
namespace rave::robot_host {

/// The values of a driver's parameters, defaults filled in. Errors: with file, line and column.
[[nodiscard]] Result<plugin::ParamSet> read_params(const plugin::Driver& driver,
                                                   const config::RawNode& params);
/// The same of a sensor. The parameter `geo_origin` of a driver that has one is the scenario's
/// where the file does not give it.
[[nodiscard]] Result<plugin::ParamSet> read_sensor_params(const DeviceContext& context,
                                                          const plugin::Driver& driver,
                                                          const config::RawNode& params);
/// Errors: kNotFound at `name`, with the nearest name there is.
[[nodiscard]] Result<const plugin::Driver*> find_driver(const DeviceContext& context,
                                                        std::span<const DriverKind> kinds,
                                                        const config::Located<std::string>& name);
[[nodiscard]] LayerMask layer_mask(const std::vector<config::SensedLayer>& layers);
[[nodiscard]] NoiseSpec noise_of(const config::NoiseFile& noise);
/// Notes the first driver that runs by the clock on the wall.
void note_clock(const DeviceContext& context, const config::RobotGroup& group,
                const std::string& device, const DriverInfo& info, const plugin::ParamSet& params);

}  // namespace rave::robot_host
