// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/plugin/params_text.hpp"

namespace rave::cli {

/// What a driver gives to programs, or accepts from them, and when its samples come. Empty for
/// drivers that do neither, such as programs and devices.
[[nodiscard]] std::vector<plugin::DriverFact> data_facts(const DriverInfo& info);

}  // namespace rave::cli
