// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave::cli {

/// `rave new`.
struct NewCommand {
  std::string kind;  ///< program or driver.
  std::string name;
  std::string directory;  ///< Empty: the name, in the current folder.
};

/// Makes a project for a robot program or driver of one's own. Returns 0 or 2.
[[nodiscard]] int new_project(const NewCommand& options);

}  // namespace rave::cli
