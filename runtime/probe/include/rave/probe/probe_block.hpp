// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::probe {

/// So long the block of a probe is at most, bytes.
inline constexpr std::size_t kLongestBlock = 2048;

/// The sensor that an entry of `sensors:` of a robot file describes, if that is a virtual one with
/// nothing but a name, a driver, a place, layers and parameters. `block`: YAML, from anybody.
/// Errors: kParse and kInvalidArgument with what was expected, kNotFound (no such driver; the
/// nearest name).
[[nodiscard]] Result<sim::SensorSpec> read_block(std::string_view block,
                                                 plugin::Catalogue& catalogue);

}  // namespace rave::probe
