// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

namespace rave::testing {

// Far beyond what any test needs: a wait that ends by it has failed.
inline constexpr std::chrono::seconds kLong{100};

/// Between two looks of a wait; a look that starts a process is better taken less often.
inline constexpr std::chrono::milliseconds kOften{10};

/// Waits until `holds()` is true. False: it never was.
template <class Holds>
[[nodiscard]] bool await(Holds&& holds, std::chrono::milliseconds pause = kOften) {
  const auto end = std::chrono::steady_clock::now() + kLong;
  while (!holds()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

}  // namespace rave::testing
