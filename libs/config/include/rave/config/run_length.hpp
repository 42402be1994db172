// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "rave/base/open_end.hpp"

namespace rave::config {

/// How long a run takes, in simulated time: a number of seconds in files, or `none` for a run that
/// continues until it is ended.
struct RunLength {
  double seconds = 60;  ///< kOpenEnd_s for an open end.

  constexpr RunLength() = default;
  constexpr RunLength(double length_s) noexcept : seconds(length_s) {}  // NOLINT: a plain number
  [[nodiscard]] constexpr operator double() const noexcept { return seconds; }  // NOLINT: as above
  [[nodiscard]] constexpr bool is_open() const noexcept { return is_open_end(seconds); }
  /// For people: 0 if it is not known when it ends.
  [[nodiscard]] constexpr double known_s() const noexcept { return is_open() ? 0 : seconds; }
  [[nodiscard]] constexpr std::optional<double> known_end_s() const noexcept {
    return is_open() ? std::nullopt : std::optional(seconds);
  }
};

}  // namespace rave::config
