// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/gui_file.hpp"

namespace rave::config {

/// The part of a scenario that configures the page.
struct GuiOfScenario {
  GuiFile gui;                               ///< As in an expanded scenario.
  std::vector<std::filesystem::path> files;  ///< That have it: the scenario, and its `gui: file:`.
};

/// Reads this part alone again, since it may change during a run. Errors: as expand_scenario().
[[nodiscard]] Result<GuiOfScenario> read_gui_of(const std::filesystem::path& scenario);

}  // namespace rave::config
