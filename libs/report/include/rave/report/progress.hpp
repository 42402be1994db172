// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rave::report {

/// What a run tells while it goes on.
struct Progress {
  double fraction = 0;          ///< Done, 0 to 1; values outside and NaN are clamped.
  double sim_s = 0;             ///< Simulation time now.
  std::optional<double> end_s;  ///< When it will end; none for an open end.
  double pace = 0;              ///< Simulated seconds per second of wall time.
  std::size_t robots = 0;
  std::string text;  ///< Anything else, such as the closest encounter; gives way first.
};

/// One line of exactly `width` terminal columns (so that it covers the line before it), without a
/// newline or carriage return. On narrow terminals parts are left out: the text is shortened, then
/// robots, bar and pace go. Control characters in the text are dropped.
[[nodiscard]] std::string format_progress(const Progress& progress, std::size_t width);

}  // namespace rave::report
