// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/plugin/registry.hpp"

namespace rave::plugin {

/// Refuses invalid descriptions: names that are empty or not lower_snake_case, empty sentences,
/// reversed ranges, defaults outside of them, null pointers. Error: kPlugin, naming driver and
/// parameter.
[[nodiscard]] Status check_description(const DriverInfo& info, const void* ops);

}  // namespace rave::plugin
