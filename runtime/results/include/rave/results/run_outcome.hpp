// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rave::runtime {

/// The outcome of a run. Its files are in `output`: result.json, summary.txt, picture.svg,
/// picture.png, events.log, run.mcap (the recording), scenario.yaml (with all defaults).
struct RunOutcome {
  /// Whether the run is complete: it reached its end, or was ended by hand, with all drivers and
  /// programs working, and all of its results were written.
  bool whole = false;
  /// Time at which a person or a signal ended it before its duration.
  std::optional<double> ended_by_hand_s{};
  bool checks_hold = true;   ///< All checks of the scenario were evaluated and hold.
  bool checks_fail = false;  ///< At least one was evaluated and does not hold.
  /// Reasons why the run is not complete, one sentence each; empty if it is.
  std::vector<std::string> problems;
  std::string hash;     ///< 16 hexadecimal digits; empty for a live run.
  std::string summary;  ///< The table for the terminal, without colours.

  /// Whether nothing went wrong. Checks for which an end by hand left no time are no failures.
  [[nodiscard]] bool good() const noexcept {
    return whole && (ended_by_hand_s ? !checks_fail : checks_hold);
  }
};

}  // namespace rave::runtime
