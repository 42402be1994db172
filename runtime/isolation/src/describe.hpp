// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "message.hpp"

namespace rave::isolation {

/// `segmentation fault`, `bus error`, ...; `signal 12` for those that are not faults.
[[nodiscard]] std::string signal_name(int signal);

/// `Wander::decide` for a linker name or a function with its parameters. `frame` is the linker's
/// name of the function that it is inlined in; it tells the class of `decide` and `start`, for
/// which the line table of an optimised program has no class.
[[nodiscard]] std::string short_function(std::string_view name, std::string_view frame = {});

/// ` at programs/wander/wander.cpp:42 in Wander::decide`, leaving out what is unknown.
[[nodiscard]] std::string at_place(const Place& place);

/// `1.0 s`, `0.25 s`.
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace rave::isolation
