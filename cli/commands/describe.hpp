// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave describe`.
struct DescribeCommand {
  std::string driver;
  bool json = false;
  bool markdown = false;
  std::vector<std::string> plugins;
};

/// Prints the descriptions of the drivers with a name; several kinds may share it. Returns 0 or 2.
[[nodiscard]] Result<int> describe(const DescribeCommand& options);

}  // namespace rave::cli
