// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "rave/assemble/devices.hpp"

// Functions used by several makers of devices.
namespace rave::runtime {

/// Like read_params(), for a sensor. A missing parameter `geo_origin` is set from the scenario.
[[nodiscard]] Result<plugin::ParamSet> read_sensor_params(const DeviceContext& context,
                                                          const plugin::Driver& driver,
                                                          const codec::RawNode& params);
/// The driver with this name. Errors: kNotFound at `name`, with the nearest existing name.
[[nodiscard]] Result<const plugin::Driver*> find_driver(const DeviceContext& context,
                                                        std::span<const DriverKind> kinds,
                                                        const codec::Located<std::string>& name);
[[nodiscard]] LayerMask layer_mask(const std::vector<config::SensedLayer>& layers);
[[nodiscard]] NoiseSpec noise_of(const config::NoiseFile& noise);
/// Records the first driver that follows the wall clock.
void note_clock(const DeviceContext& context, const config::RobotGroup& group,
                const std::string& device, const DriverInfo& info, const plugin::ParamSet& params);
/// A time of the scenario in steps; 1 if unset.
[[nodiscard]] std::uint32_t in_steps(const DeviceContext& context,
                                     const std::optional<codec::Located<double>>& time_s);

/// Sets name, driver and function table of a device. Errors: those of find_driver().
template <class File, class Spec>
[[nodiscard]] Result<const plugin::Driver*> begin_device(const DeviceContext& context,
                                                         DriverKind kind, const File& file,
                                                         Spec& spec) {
  RAVE_TRY_ASSIGN(const plugin::Driver* const driver,
                  find_driver(context, std::span(&kind, 1), file.driver));
  spec.name = file.name.value;
  spec.driver = driver->info.name;
  spec.where = file.driver.where;
  spec.ops = static_cast<decltype(spec.ops)>(driver->ops);
  return driver;
}

/// Sets period and phase.
template <class File, class Spec>
void set_rhythm(const DeviceContext& context, const File& file, Spec& spec) {
  spec.period_steps = in_steps(context, file.period_s);
  spec.phase_steps = file.phase_s.value == 0 ? 0 : in_steps(context, file.phase_s);
}

}  // namespace rave::runtime
