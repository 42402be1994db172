// SPDX-License-Identifier: Apache-2.0
#include "own_clock.hpp"

#include <ctime>

namespace peer {

std::int64_t true_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace peer
