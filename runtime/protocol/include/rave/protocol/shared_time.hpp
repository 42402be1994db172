// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "rave/base/time.hpp"
#include "rave/bus/clock_offset.hpp"

namespace rave::real_time {

/// The time of a run in the clock of this process, estimated from the clock of the Environment
/// Manager. Local times are those of the monotonic clock of this machine, in nanoseconds. A value;
/// one owner thread.
class SharedTime {
 public:
  /// For a run without a manager: sets time 0, for this process only.
  void begin_alone(std::int64_t local_ns);
  /// Adds an answer of a manager: the clock exchange, whether the run has begun, and its time 0 in
  /// the manager's clock. An answer of another manager counts once its run has begun. Error
  /// kInvalidArgument: an impossible exchange; nothing changes.
  Status hear(std::uint64_t manager, const bus::ClockExchange& exchange, bool begun,
              std::int64_t zero_ns);

  /// Whether the run has begun or its start time is set.
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// Local time at which the run is at 0; improves slightly with each answer. Precondition:
  /// known().
  [[nodiscard]] std::int64_t zero_ns() const noexcept { return zero_ns_; }
  [[nodiscard]] SimTime at(std::int64_t local_ns) const noexcept { return {local_ns - zero_ns_}; }
  /// The offset of the manager's clock; empty without an answer in the last ten seconds.
  [[nodiscard]] std::optional<bus::ClockReading> reading(std::int64_t local_ns) const {
    return offset_.at(local_ns);
  }

 private:
  bus::ClockOffset offset_;
  std::uint64_t manager_ = 0;
  bool known_ = false;
  std::int64_t zero_ns_ = 0;
};

}  // namespace rave::real_time
