// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::config {

/// The upper limit of simulated time per wall time.
struct Pace {
  /// Simulated seconds per wall second; 0: no limit.
  double factor = 0;

  [[nodiscard]] bool is_max() const noexcept { return factor == 0; }
  bool operator==(const Pace&) const = default;
};

/// Parses `max`, `realtime` or a positive number followed by `x`, such as `10x`. Error: kParse.
[[nodiscard]] Result<Pace> parse_pace(std::string_view text);
/// The inverse of parse_pace().
[[nodiscard]] std::string to_string(const Pace& pace);

}  // namespace rave::config
