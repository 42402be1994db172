// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands/run.hpp"
#include "page.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave gui`.
struct GuiCommand {
  /// A recording, the folder of a run, or a scenario; empty: the page starts runs itself.
  std::string file;
  RunCommand run;  ///< Of a scenario: where its run is, and plug-ins.
  PageOptions page;
};

/// Serves the page until SIGINT or SIGTERM. Returns 0, or 2 on bad input.
[[nodiscard]] Result<int> gui(const GuiCommand& options);

}  // namespace rave::cli
