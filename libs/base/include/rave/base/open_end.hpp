// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave {

/// The duration of a run that continues until it is ended: 31 years. Whatever counts steps has a
/// number, and no run gets there.
inline constexpr double kOpenEnd_s = 1e9;

/// Whether a run of this duration has an open end.
[[nodiscard]] constexpr bool is_open_end(double duration_s) noexcept {
  return duration_s >= kOpenEnd_s;
}

}  // namespace rave
