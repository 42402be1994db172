// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "message.hpp"

namespace rave::isolation {

/// `segmentation fault`, `bus error`, ...; `signal 12` for those that are not faults.
[[nodiscard]] std::string signal_name(int signal);

/// `Wander::decide` for a linker name or a function with its parameters.
[[nodiscard]] std::string short_function(std::string_view name);

/// ` at programs/wander/wander.cpp:42 in Wander::decide`, leaving out what is unknown.
[[nodiscard]] std::string at_place(const Place& place);

/// `1.0 s`, `0.25 s`.
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace rave::isolation
