// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "rave/base/time.hpp"
#include "rave/bus/clock_offset.hpp"

namespace rave::real_time {

/// The time of a run by the clock of this process: how long ago it was 0 by the clock of the
/// environment manager, as far as one can know. Times named local are those of the monotonic clock
/// of this machine, in nanoseconds. A value; one owner thread.
class SharedTime {
 public:
  /// The run has no manager: it is 0 at `local_ns`, for this process alone.
  void begin_alone(std::int64_t local_ns);
  /// An answer of a manager: the exchange, whether the run has begun for it and where it is 0 by
  /// its clock. Of another manager than before it counts from when that one has begun. Error
  /// kInvalidArgument: the exchange cannot be; then nothing has changed.
  Status hear(std::uint64_t manager, const bus::ClockExchange& exchange, bool begun,
              std::int64_t zero_ns);

  /// Whether the run has begun, or is about to.
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// How often the manager has answered.
  [[nodiscard]] std::uint64_t answers() const noexcept { return answers_; }
  /// Local time at which the run is 0; changes a little as more is known. Needs known().
  [[nodiscard]] std::int64_t zero_ns() const noexcept { return zero_ns_; }
  [[nodiscard]] SimTime at(std::int64_t local_ns) const noexcept { return {local_ns - zero_ns_}; }
  /// Where the clock of the manager stands; nothing without an answer in the last ten seconds.
  [[nodiscard]] std::optional<bus::ClockReading> reading(std::int64_t local_ns) const {
    return offset_.at(local_ns);
  }

 private:
  bus::ClockOffset offset_;
  std::uint64_t manager_ = 0;
  std::uint64_t answers_ = 0;
  bool known_ = false;
  std::int64_t zero_ns_ = 0;
};

}  // namespace rave::real_time
