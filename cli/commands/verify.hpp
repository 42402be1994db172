// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave verify`.
struct VerifyCommand {
  std::string file;  ///< A record, or the folder of a run.
  std::optional<int> threads;
  bool quiet = false;
  std::vector<std::string> plugins;
};

/// Repeats the run of a recording and compares. Returns 0 if all bits are equal, 1 if something
/// differs, 2 if it cannot be repeated (a live run, missing files, not a recording).
[[nodiscard]] Result<int> verify(const VerifyCommand& options);

}  // namespace rave::cli
