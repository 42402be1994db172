// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/introduction.hpp"

namespace rave::lock_step {

/// Tells those who look on how a process of a run fares (topic rave/process). Must be gone before
/// its bus; thread: that of the bus.
class Pulse {
 public:
  /// How it keeps the deadlines of its steps, if these are by the clock on the wall.
  struct Lateness {
    std::uint64_t deadlines = 0;  ///< That have passed.
    std::uint64_t missed = 0;
    std::int64_t worst_ns = 0;
    std::int64_t behind_ns = 0;  ///< How late its last step was.
    std::string phase;           ///< Most to blame; empty: nothing was missed.
  };
  /// What the process knows of itself.
  struct Facts {
    std::uint64_t step = 0;
    std::uint64_t missed = 0;         ///< Worlds that never came.
    std::int64_t round_trip_ns = -1;  ///< To the manager and back; -1: not known.
    Lateness lateness{};
  };

  static constexpr std::chrono::nanoseconds kPeriod{std::chrono::seconds(1)};

  /// `period`: between two beats that nothing hurries. Errors: those of bus::Writer::create().
  [[nodiscard]] static Result<Pulse> create(bus::Bus& bus, const Identity& self,
                                            std::chrono::nanoseconds period = kPeriod);

  /// To be called often: sends the facts once in a period, and otherwise only reads the clock.
  void beat(const Facts& facts);
  /// So many of its robots are real now: told with the next beat, which does not wait for its
  /// period to be over.
  void count_real(std::uint32_t robots) noexcept;

 private:
  using Clock = std::chrono::steady_clock;
  Pulse(bus::Bus& bus, bus::Writer<bus::ProcessState> writer, const Identity& self,
        std::chrono::nanoseconds period);

  bus::Bus* bus_;
  bus::Writer<bus::ProcessState> writer_;
  bus::ProcessState state_{};
  std::chrono::nanoseconds period_;
  Clock::time_point next_{};
};

}  // namespace rave::lock_step
