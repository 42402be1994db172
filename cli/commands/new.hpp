// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave new`.
struct NewCommand {
  std::string kind;  ///< program, driver or panel.
  std::string name;
  std::string directory;  ///< Empty: the name, in the current folder.
};

/// Makes a project for a robot program, driver or panel of one's own. Returns 0 or 2.
[[nodiscard]] Result<int> new_project(const NewCommand& options);

}  // namespace rave::cli
