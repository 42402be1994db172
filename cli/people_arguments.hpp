// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/people.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Adds `people` with its subcommands, all of which write what they are given to `command`.
void add_people(CLI::App& root, PeopleCommand& command);

/// The command for the subcommand of that name.
[[nodiscard]] PeopleCommand chosen_people(const std::string& name, PeopleCommand command);

}  // namespace rave::cli
