// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::config {

/// How fast simulated time may pass against wall time.
struct Pace {
  /// Simulated seconds per wall second; 0: as fast as it can.
  double factor = 0;

  [[nodiscard]] bool is_max() const noexcept { return factor == 0; }
  bool operator==(const Pace&) const = default;
};

/// Reads `max`, `realtime` or a positive number followed by `x`, such as `10x`.
[[nodiscard]] Result<Pace> parse_pace(std::string_view text);
/// The text that parse_pace reads back.
[[nodiscard]] std::string to_string(const Pace& pace);

}  // namespace rave::config
