// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/run.hpp"
#include "rave/base/result.hpp"
#include "rave/replay/played_scenario.hpp"

namespace rave::cli {

/// `rave play`.
struct PlayCommand {
  std::string file;           ///< A record, or the folder of a run.
  replay::PlayArguments how;  ///< Its record and folder are set by play().
  std::string write;          ///< A folder to write the scenario to, without running it.
  RunCommand run;             ///< How it is run; its scenario is set by play().
};

/// Turns the robots of a recording into recorded real robots and runs them. Returns the exit code
/// of `rave run`.
[[nodiscard]] Result<int> play(const PlayCommand& options);

}  // namespace rave::cli
