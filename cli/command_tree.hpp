// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace rave::cli {

/// The names, options and texts of a command and its subcommands, as JSON: what man pages, shell
/// completion and docs/reference/commands.md are made from. Options that help hides are left out.
[[nodiscard]] std::string command_tree(const CLI::App& root);

}  // namespace rave::cli
