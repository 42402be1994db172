// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/control.hpp"
#include "commands/edit.hpp"
#include "commands/end.hpp"
#include "commands/hand_over.hpp"
#include "commands/order.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Options of the commands that act on a run in progress.
struct ControlCommands {
  PsCommand ps;
  StopCommand stop;
  ArmCommand arm;
  SetCommand set;
  HoldCommand hold;  ///< Of `pause`, `resume` and `step`.
  EndCommand end;
  HandOverCommand hand_over;
  ShadowCommand shadow;
  EditCommand edit;
  OrderCommand drive;
  OrderCommand goal;
  OrderCommand say;
  OrderCommand place;
};

/// Adds `ps`, `stop`, `arm`, `set`, `pause`, `resume`, `step`, `end`, `hand-over`, `shadow`,
/// `edit`, `drive`, `goal`, `say` and `place`, which write what they are given to `commands`.
void add_control_commands(CLI::App& root, ControlCommands& commands);

}  // namespace rave::cli
