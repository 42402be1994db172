// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave drivers`.
struct DriversCommand {
  std::string kind;  ///< Empty: all.
  bool json = false;
  bool markdown = false;  ///< The whole reference, one section for each.
  std::vector<std::string> plugins;
};

/// Lists the available drivers, and below them the plug-ins that could not be used. Returns 0, or 2
/// for an unknown kind or a missing folder.
[[nodiscard]] Result<int> drivers(const DriversCommand& options);

}  // namespace rave::cli
