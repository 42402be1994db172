// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rave::cli {

/// `rave verify`.
struct VerifyCommand {
  std::string file;  ///< A record, or the folder of a run.
  std::optional<int> threads;
  bool quiet = false;
  std::vector<std::string> plugins;
};

/// Runs what a record holds again and compares. Returns 0 if it is the same to the bit, 1 if it
/// differs, 2 if it cannot be run again (a live run, files that are missing, no record).
[[nodiscard]] int verify(const VerifyCommand& options);

}  // namespace rave::cli
