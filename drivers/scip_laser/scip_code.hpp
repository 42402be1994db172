// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::scip {

// Source of everything in this folder: Hokuyo Automatic Co., "Communication Protocol Specification
// For SCIP2.0 Standard", C-42-03320B.

/// The character that closes a line: low six bits of the sum of its characters, plus 0x30.
[[nodiscard]] char checksum(std::string_view text) noexcept;

/// A number of 2 to 4 characters, six bits each from the highest, each plus 0x30. None if a
/// character is outside 0x30 to 0x6f.
[[nodiscard]] std::optional<std::uint32_t> decode(std::string_view characters) noexcept;

/// The device's timer of 24 bits in milliseconds, extended beyond its wrap-around.
class UnwrappedTime {
 public:
  /// Seconds since the timer's zero before the first call. A reading below the last one counts as a
  /// wrap-around (4.66 h) if it is less than half a period ahead, otherwise as a step back.
  [[nodiscard]] double seconds(std::uint32_t timer_ms) noexcept;
  void reset() noexcept { last_ms_ = -1; }

 private:
  std::int64_t last_ms_ = -1;
};

}  // namespace rave::scip
