// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace rave::cli {

/// `rave check`.
struct CheckCommand {
  std::vector<std::string> files;
  bool expand = false;
  std::string draw;  ///< Where to draw; empty: nowhere.
  std::vector<std::string> plugins;
};

/// Says whether files are right, and if not, everything that is wrong. Returns 0 or 2.
[[nodiscard]] int check(const CheckCommand& options);

}  // namespace rave::cli
