// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rave {

/// A duration in whole nanoseconds. Signed 64 bits: about 292 years.
struct Duration {
  std::int64_t ns = 0;

  [[nodiscard]] constexpr double seconds() const noexcept { return static_cast<double>(ns) * 1e-9; }

  friend constexpr bool operator==(Duration, Duration) noexcept = default;
  friend constexpr auto operator<=>(Duration, Duration) noexcept = default;
  friend constexpr Duration operator+(Duration a, Duration b) noexcept { return {a.ns + b.ns}; }
  friend constexpr Duration operator-(Duration a, Duration b) noexcept { return {a.ns - b.ns}; }
  friend constexpr Duration operator*(Duration a, std::int64_t k) noexcept { return {a.ns * k}; }
};

/// Rounds to the nearest nanosecond. `seconds` must be finite and within +-9e9.
[[nodiscard]] constexpr Duration from_seconds(double seconds) noexcept {
  const double ns = seconds * 1e9;
  return {static_cast<std::int64_t>(ns < 0 ? ns - 0.5 : ns + 0.5)};
}

/// A time of the run: nanoseconds since its start. Code on the stepped path reads no other clock;
/// wall time is in `rave/base/wall_clock.hpp`.
struct SimTime {
  std::int64_t ns = 0;

  [[nodiscard]] constexpr double seconds() const noexcept { return static_cast<double>(ns) * 1e-9; }

  friend constexpr bool operator==(SimTime, SimTime) noexcept = default;
  friend constexpr auto operator<=>(SimTime, SimTime) noexcept = default;
  friend constexpr Duration operator-(SimTime a, SimTime b) noexcept { return {a.ns - b.ns}; }
  friend constexpr SimTime operator+(SimTime a, Duration b) noexcept { return {a.ns + b.ns}; }
  friend constexpr SimTime operator-(SimTime a, Duration b) noexcept { return {a.ns - b.ns}; }
};

}  // namespace rave
