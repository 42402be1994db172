// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cmath>

namespace rave::isolation {

/// The point in wall time after which a child counts as stuck. It affects a run only through giving
/// up that child.
class Deadline {
 public:
  Deadline() = default;
  explicit Deadline(double seconds)
      : end_(Clock::now() +
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  /// Rounded up; 0 when it has passed.
  [[nodiscard]] int remaining_ms() const {
    const double left_ms = std::chrono::duration<double, std::milli>(end_ - Clock::now()).count();
    return left_ms > 0 ? static_cast<int>(std::ceil(left_ms)) : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point end_;
};

}  // namespace rave::isolation
