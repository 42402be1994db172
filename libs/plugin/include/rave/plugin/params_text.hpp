// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/plugin/catalogue.hpp"

namespace rave::plugin {

/// The name of a parameter type for people: `bool`, `integer`, `number`, `text`, `choice`, `list`.
[[nodiscard]] std::string_view to_string(ParamType type) noexcept;

/// The values that a parameter takes: `0.1 to 5`, `0 or more`, `at most 5`, `slow, fast`; empty
/// where every value will do.
[[nodiscard]] std::string range_text(const ParamSpec& spec);

/// The default as a file would write it; `required` if a file must give one.
[[nodiscard]] std::string default_text(const ParamSpec& spec);

/// The page that `rave describe NAME` prints: plain text in columns, at most 100 wide but for the
/// path of the file, which stays whole so that it can be copied.
[[nodiscard]] std::string describe(const Driver& driver);

/// The same as a section of the generated reference. Without the folder of the file, so that the
/// reference is the same on every machine.
[[nodiscard]] std::string markdown(const Driver& driver);

}  // namespace rave::plugin
