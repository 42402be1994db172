// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave check`.
struct CheckCommand {
  std::vector<std::string> files;
  bool expand = false;
  std::string draw;              ///< File for the drawing; empty: none.
  std::vector<std::string> set;  ///< KEY=VALUE, for scenarios; see config::Settings.
  std::vector<std::string> plugins;
};

/// Checks files and prints all errors. Returns 0 or 2.
[[nodiscard]] Result<int> check(const CheckCommand& options);

}  // namespace rave::cli
