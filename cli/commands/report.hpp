// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/replay/gap.hpp"

namespace rave::cli {

/// `rave report gap`.
struct GapCommand {
  std::string file;  ///< A record, or the folder of a run.
  runtime::GapOptions gap;
  std::string output;  ///< Folder of picture and numbers; empty: that of the record.
  bool json = false;
  std::vector<std::string> plugins;
};

/// Compares a recorded robot with its simulated twin. Returns 0, or 2 if it cannot.
[[nodiscard]] Result<int> report_gap(const GapCommand& options);

}  // namespace rave::cli
