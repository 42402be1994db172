// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/line/clock_offset.hpp"

namespace rave::ros2_driver {

/// Converts the stamps of one topic to the host's clock, whatever clock they are from: that of
/// another machine, or of a simulation. Pure: reads no clock. Not thread-safe.
class StreamClock {
 public:
  struct Taken {
    /// False: not newer than the previous one, or it seems to arrive before it was sent.
    bool good = false;
    /// The sender began anew, or its clock was set: what was known of its clock does not count any
    /// more, so messages that are late from now on may look fresh.
    bool anew = false;
    /// Time at which the message was true, in the host's clock, least delay included.
    double host_s = 0;
  };
  /// Adds a message with this stamp that arrived at `arrived_s`. A stamp of 0 means none: true on
  /// arrival.
  [[nodiscard]] Taken take(std::int64_t stamp_ns, double arrived_s);
  /// Forgets earlier messages, for a new sender.
  void restart();

  [[nodiscard]] std::uint64_t old() const noexcept { return old_; }
  /// How many were not believed because they seemed to arrive before they were sent.
  [[nodiscard]] std::uint64_t early() const noexcept { return early_; }
  [[nodiscard]] std::uint64_t restarts() const noexcept { return restarts_; }
  [[nodiscard]] double drift_ppm() const noexcept { return clock_.drift_ppm(); }

 private:
  line::ClockOffset clock_;
  bool any_ = false;
  std::int64_t origin_ns_ = 0;
  std::int64_t newest_ns_ = 0;
  std::int64_t previous_old_ns_ = 0;
  int old_in_a_row_ = 0;
  std::uint64_t old_ = 0;
  std::uint64_t early_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace rave::ros2_driver
