// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace rave::cli {

/// The subcommand that was named, as far down as names went.
[[nodiscard]] const CLI::App& chosen_app(const CLI::App& root);

/// Prints that a first word is no subcommand, with the nearest one, and returns the exit code;
/// empty if it is one.
[[nodiscard]] std::optional<int> unknown_subcommand(const CLI::App& root, const std::string& word);

/// Prints what is wrong with the arguments, in the style of errors in files: what was found, what
/// was expected, and of an unknown option the nearest one. Returns the exit code.
[[nodiscard]] int usage_error(const CLI::App& root, const CLI::ParseError& e);

}  // namespace rave::cli
