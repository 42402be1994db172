// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "page.hpp"
#include "places.hpp"
#include "rave/base/result.hpp"
#include "rave/launch/run_settings.hpp"

namespace rave::cli {

/// `rave run`. What is unset comes from the scenario.
struct RunCommand : launch::RunSettings {
  RunCommand() { program = executable_folder() / "rave"; }

  std::string output;    ///< Empty: runs/<time>-<scenario>.
  bool replace = false;  ///< Remove the results of an earlier run there.
  std::optional<int> threads;
  std::optional<std::string> pace;
  bool dry_run = false;  ///< Print what would happen; start nothing.
  bool paused = false;   ///< Wait before the first step until a person resumes it.
  bool quiet = false;
  bool gui = false;  ///< Show it in the browser, then its recording.
  /// Run the robots in a process of their own even if the scenario names no hosts, so that pages of
  /// other processes can look on.
  bool on_bus = false;
  bool with_parent = false;  ///< End when the process that started this one has ended.
  PageOptions page;
};

/// Runs a scenario. Returns 0 if it completed and its checks hold, 1 if not, 2 on bad input.
[[nodiscard]] Result<int> run(const RunCommand& options);

}  // namespace rave::cli
