// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rave/base/error.hpp"
#include "terminal.hpp"

namespace rave::cli {

/// The exit codes of every subcommand.
inline constexpr int kGood = 0;
inline constexpr int kNotGood = 1;   ///< An incomplete run, or failed checks.
inline constexpr int kBadInput = 2;  ///< Wrong usage or wrong files.

/// An Error for people: each of its lines, and below those with a place the line of the file with
/// a caret. Ends in a newline.
[[nodiscard]] std::string error_text(const Error& error, const Terminal& terminal);

/// Prints an Error to stderr, after `rave: ` if it has no place, and returns kBadInput.
int complain(const Error& error);

/// Splits the place off a message: `file:line:column: message`.
struct PlacedMessage {
  SourceLocation where;  ///< Without a file if the message has no place.
  std::string message;
};
[[nodiscard]] PlacedMessage parse_message(std::string_view line);

}  // namespace rave::cli
