// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/gui_file.hpp"

namespace rave::config {

/// The part of a scenario that configures the page.
struct GuiOfScenario {
  GuiFile gui;  ///< As in an expanded scenario.
  /// The files that contain it: the scenario, and the file that its `gui: file:` names, if any.
  std::vector<std::filesystem::path> files;
};

/// Reads only this part of a scenario, as it is now: its files may change during a run. Errors: as
/// expand_scenario().
[[nodiscard]] Result<GuiOfScenario> read_gui_of(const std::filesystem::path& scenario);

}  // namespace rave::config
