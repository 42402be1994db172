// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/check.hpp"
#include "commands/describe.hpp"
#include "commands/drivers.hpp"
#include "commands/new.hpp"
#include "commands/schema.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Options of the commands about files, drivers and projects.
struct FileCommands {
  CheckCommand check;
  DriversCommand drivers;
  DescribeCommand describe;
  NewCommand make;
  SchemaCommand schema;
};

/// Adds `check`, `drivers`, `describe`, `new` and `schema`, which write what they are given to
/// `commands`.
void add_file_commands(CLI::App& root, FileCommands& commands);

}  // namespace rave::cli
