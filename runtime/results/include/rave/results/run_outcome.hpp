// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rave::runtime {

/// How a run ended. What it found lies in `output`: result.json, summary.txt, picture.svg,
/// picture.png, events.log, run.mcap (everything that happened), scenario.yaml (with all defaults).
struct RunOutcome {
  bool whole = false;                 ///< Ran to its end without losing a driver or a program.
  bool checks_hold = true;            ///< All checks of the scenario were made and hold.
  bool checks_fail = false;           ///< One was made and does not hold.
  std::vector<std::string> problems;  ///< One sentence each for why not; empty if all is well.
  std::string hash;                   ///< 16 hexadecimal digits; empty for a live run.
  std::string summary;                ///< The table for a terminal, without colours.
};

}  // namespace rave::runtime
