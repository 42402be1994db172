// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::probe {

/// Largest size of the block of a probe in bytes.
inline constexpr std::size_t kLongestBlock = 2048;

/// Parses the sensor of a probe: an entry of `sensors:` of a robot file with a virtual driver and
/// nothing but name, driver, mount, layers and parameters. `block`: untrusted YAML. Errors: kParse
/// and kInvalidArgument with what was expected, kNotFound (no such driver; with the nearest name).
[[nodiscard]] Result<sim::SensorSpec> read_block(std::string_view block,
                                                 plugin::Catalogue& catalogue);

}  // namespace rave::probe
