// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>

// Clocks of this machine, for code that is not on the stepped path. Any thread.
namespace rave {

/// Nanoseconds of a second.
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// The time of day: nanoseconds since 1970, UTC. It may be set forwards and back.
[[nodiscard]] inline std::int64_t wall_ns() noexcept {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// Nanoseconds of a clock that is never set.
[[nodiscard]] inline std::int64_t steady_ns() noexcept {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace rave
