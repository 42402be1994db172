// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/plugin/params.hpp"

namespace rave::sim::testing {

/// The number that a test has given to its driver; 0 if it has given none. Drivers of tests declare
/// no parameters, so Params::number() would refuse.
[[nodiscard]] inline double given(const Params& params, std::string_view name) noexcept {
  for (const ParamValue& value : params.values()) {
    if (name == value.name) return value.number;
  }
  return 0;
}

}  // namespace rave::sim::testing
