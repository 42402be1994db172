// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace peer {

/// Nanoseconds of CLOCK_MONOTONIC: the truth, the same in all processes of a machine.
[[nodiscard]] std::int64_t true_ns();

/// A clock of a device: it begins somewhere and runs at its own speed.
class OwnClock {
 public:
  /// Shows `start_s` now, and gains `drift_ppm` microseconds each second.
  OwnClock(double start_s, double drift_ppm) : start_s_(start_s), rate_(1 + drift_ppm * 1e-6) {}
  void restart() { began_ns_ = true_ns(); }
  [[nodiscard]] double seconds_at(std::int64_t t_ns) const {
    return start_s_ + static_cast<double>(t_ns - began_ns_) * 1e-9 * rate_;
  }

 private:
  double start_s_;
  double rate_;
  std::int64_t began_ns_ = true_ns();
};

}  // namespace peer
