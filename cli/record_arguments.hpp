// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/export.hpp"
#include "commands/gui.hpp"
#include "commands/info.hpp"
#include "commands/play.hpp"
#include "commands/report.hpp"
#include "commands/verify.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// What those about the record of a run are given.
struct RecordCommands {
  InfoCommand info;
  VerifyCommand verify;
  PlayCommand play;
  ExportCommand csv;
  GapCommand gap;
  GuiCommand gui;
};

/// Adds `info`, `verify`, `play`, `export`, `report gap` and `gui`, which write what they are given
/// to `commands`.
void add_record_commands(CLI::App& root, RecordCommands& commands);

}  // namespace rave::cli
