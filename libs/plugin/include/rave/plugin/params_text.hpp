// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rave/plugin/catalogue.hpp"

namespace rave::plugin {

/// The name of a parameter type in messages: `bool`, `integer`, `number`, `text`, `choice`, `list`.
[[nodiscard]] std::string_view to_string(ParamType type) noexcept;

/// The permitted values of a parameter: `0.1 to 5`, `0 or more`, `at most 5`, `slow, fast`; empty
/// if every value is permitted.
[[nodiscard]] std::string range_text(const ParamSpec& spec);

/// The default in the notation of a file, or `required` if there is none.
[[nodiscard]] std::string default_text(const ParamSpec& spec);

/// A property of a driver that the caller adds, because this library has no names for kinds of
/// data.
struct DriverFact {
  std::string key;  ///< One word in lower case, such as `gives`.
  std::string value;
};

/// The output of `rave describe NAME`: plain text in columns, with `facts` after the clock. Lines
/// have at most 100 characters, except for the path of the file, which is not wrapped so that it
/// can be copied.
[[nodiscard]] std::string describe(const Driver& driver, std::span<const DriverFact> facts = {});

/// The driver as a section of the generated reference. It omits the folder of the file, so the
/// reference is equal on every machine.
[[nodiscard]] std::string markdown(const Driver& driver, std::span<const DriverFact> facts = {});

}  // namespace rave::plugin
