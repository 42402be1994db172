// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "message.hpp"

namespace rave::isolation {

/// The name of a fault, such as `segmentation fault` or `bus error`; `signal 12` for other signals.
[[nodiscard]] std::string signal_name(int signal);

/// `Wander::decide` for a linker name or a function with its parameters. `frame` is the linker's
/// name of the function that it is inlined in; it tells the class of `decide` and `start`, for
/// which the line table of an optimised program has no class.
[[nodiscard]] std::string short_function(std::string_view name, std::string_view frame = {});

/// ` at programs/wander/wander.cpp:42 in Wander::decide`, leaving out what is unknown.
[[nodiscard]] std::string at_place(const Place& place);

/// A duration as text, such as `1.0 s` or `0.25 s`.
[[nodiscard]] std::string seconds_text(double seconds);

}  // namespace rave::isolation
