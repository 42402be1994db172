// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/replay/gap.hpp"

namespace rave::cli {

/// `rave report FOLDER`.
struct ReportCommand {
  std::string folder;  ///< Of a sweep.
  std::string output;  ///< Folder for the page; empty: that of the sweep.
  bool quiet = false;
};

/// Writes report.html and conditions.csv of a sweep and prints a summary. Returns 0, or 1 if the
/// runs do not show what the experiment file expects.
[[nodiscard]] Result<int> report_experiment(const ReportCommand& options);

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
