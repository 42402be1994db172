// SPDX-License-Identifier: Apache-2.0
// Whether this process stood still, suspended or starved. Meanwhile it received nothing, so others
// may seem lost that are not.
#include "rave/bus/standstill.hpp"

#include <algorithm>
#include <ctime>

namespace rave::bus {

void Standstill::look(Duration waited) {
  std::timespec boot{};
  // The monotonic clock of Linux stops while the machine is suspended; this one does not.
  ::clock_gettime(CLOCK_BOOTTIME, &boot);
  look(Clock::now(), std::chrono::seconds(boot.tv_sec) + std::chrono::nanoseconds(boot.tv_nsec),
       waited);
}

void Standstill::look(Clock::time_point now, std::chrono::nanoseconds elapsed, Duration waited) {
  const std::int64_t gap_ns = last_.count() < 0 ? 0 : (elapsed - last_).count();
  last_ = elapsed;
  // After waiting without a limit, a long gap says nothing.
  if (waited.ns < 0 || gap_ns - waited.ns <= longest_.ns) return;
  const Duration gap{gap_ns - waited.ns};
  stood_ = now < counts_from_ ? std::max(stood_, gap) : gap;
  counts_from_ = now + std::chrono::nanoseconds(grace_.ns);
}

}  // namespace rave::bus
