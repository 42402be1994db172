// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "rave/plugin/params_text.hpp"
#include "rave/robot/reading.hpp"

namespace rave::cli {

/// The C++ type of one record of a kind, as programs give it to `Setup::sensor<T>()`; empty for
/// kNone.
[[nodiscard]] std::string_view record_type(ReadingKind kind) noexcept;

/// What a driver gives to programs, or accepts from them, and when its samples come. Empty for
/// drivers that do neither, such as programs and devices.
[[nodiscard]] std::vector<plugin::DriverFact> data_facts(const DriverInfo& info);

}  // namespace rave::cli
