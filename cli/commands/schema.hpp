// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave schema`.
struct SchemaCommand {
  std::string kind;  ///< robot, world or scenario.
};

/// Prints the JSON Schema of a kind of file. Returns 0 or 2.
[[nodiscard]] Result<int> schema(const SchemaCommand& options);

}  // namespace rave::cli
