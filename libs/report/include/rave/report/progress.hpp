// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rave::report {

/// The state of a run for its progress line.
struct Progress {
  double fraction = 0;          ///< Finished part, 0 to 1; values outside are clamped, NaN too.
  double sim_s = 0;             ///< Current simulation time.
  std::optional<double> end_s;  ///< Simulation time of the end; empty if open-ended.
  double pace = 0;              ///< Simulated seconds per second of wall time.
  std::size_t robots = 0;
  std::string text;  ///< Further text, such as the closest encounter; omitted first.
};

/// A progress line of exactly `width` terminal columns (so that it overwrites the previous one),
/// without newline or carriage return. On narrow terminals parts are omitted: first the text is
/// shortened, then robots, bar and pace are dropped. Control characters in the text are removed.
[[nodiscard]] std::string format_progress(const Progress& progress, std::size_t width);

}  // namespace rave::report
