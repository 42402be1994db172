// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave branch`.
struct BranchCommand {
  std::string file;  ///< A record, or the folder of a run.
  double at_s = 0;
  std::vector<std::string> set;   ///< ROBOT.KEY=VALUE
  std::vector<std::string> edit;  ///< JSON; see config::read_edit().
  bool with_people = false;
  std::optional<double> until_s;
  std::string output;
  bool replace = false;
  bool quiet = false;
  bool no_picture = false;
  std::vector<std::string> plugins;
};

/// Repeats a run up to a time and continues it with something different. Returns 0 if the branch is
/// complete; 1 if not, or if the repetition differs from the recording; 2 on bad input.
[[nodiscard]] Result<int> branch(const BranchCommand& options);

/// `rave diff`.
struct DiffCommand {
  std::string first;  ///< Records, or folders of runs.
  std::string second;
  bool quiet = false;
};

/// Tells where two runs part and how far apart they are after. Returns 0 if they are equal, 1 if
/// not, 2 on bad input.
[[nodiscard]] Result<int> diff(const DiffCommand& options);

}  // namespace rave::cli
