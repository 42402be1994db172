// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

namespace rave::testing {

// Far longer than any test needs: a wait that reaches it has failed.
inline constexpr std::chrono::seconds kLong{100};

/// The pause between two checks of a wait; use a longer one if a check starts a process.
inline constexpr std::chrono::milliseconds kOften{10};

/// Waits until `holds()` is true. False: it did not become true within kLong.
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
