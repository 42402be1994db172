// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/introduction.hpp"

namespace rave::lock_step {

/// Publishes the state of a process of a run for monitors (topic rave/process). Destroy it before
/// its bus; thread: that of the bus.
class Pulse {
 public:
  /// Missed deadlines, if its steps follow the wall clock.
  struct Lateness {
    std::uint64_t deadlines = 0;  ///< Number of passed deadlines.
    std::uint64_t missed = 0;
    std::int64_t worst_ns = 0;
    std::int64_t behind_ns = 0;  ///< Delay of the last step.
    std::string phase;  ///< Phase that caused most of the misses; empty: nothing was missed.
  };
  /// The state of the process.
  struct Facts {
    std::uint64_t step = 0;
    std::uint64_t missed = 0;         ///< World messages that never arrived.
    std::int64_t round_trip_ns = -1;  ///< Round-trip time to the manager; -1: unknown.
    Lateness lateness{};
  };

  static constexpr std::chrono::nanoseconds kPeriod{std::chrono::seconds(1)};

  /// Comes before any beat(). `period`: time between two messages without a change. Errors: those
  /// of bus::Writer::open().
  [[nodiscard]] Status open(bus::Bus& bus, const Identity& self,
                            std::chrono::nanoseconds period = kPeriod);

  /// Call it often: it publishes once per period, and otherwise only reads the clock.
  void beat(const Facts& facts);
  /// Sets the number of its real robots, which is published with the next beat() without waiting
  /// for the period.
  void count_real(std::uint32_t robots) noexcept;

 private:
  using Clock = std::chrono::steady_clock;

  bus::Bus* bus_ = nullptr;
  bus::Writer<bus::ProcessState> writer_;
  bus::ProcessState state_{};
  std::chrono::nanoseconds period_ = kPeriod;
  Clock::time_point next_{};
};

}  // namespace rave::lock_step
