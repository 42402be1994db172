// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rave::watch {

/// The difference of two times in seconds.
[[nodiscard]] constexpr double seconds_of(std::int64_t ns) noexcept {
  return static_cast<double>(ns) * 1e-9;
}

}  // namespace rave::watch
