// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/keys.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Options of the subcommands of `keys`.
struct KeysCommands {
  KeysNewCommand make;
  KeysAddCommand add;
  KeysShowCommand show;
  KeysWebCommand web;
  KeysLineCommand line;
};

/// Adds `keys new`, `keys add`, `keys show`, `keys web` and `keys line`, which write what they are
/// given to `commands`.
void add_keys_commands(CLI::App& root, KeysCommands& commands);

}  // namespace rave::cli
