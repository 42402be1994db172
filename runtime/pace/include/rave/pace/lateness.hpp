// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rave/sim/phase_clock.hpp"

namespace rave::runtime {

/// How a paced run kept its deadlines. A step is due at its time on the wall, and its deadline is
/// when the next one is due.
struct LatenessFacts {
  std::uint64_t deadlines = 0;  ///< That have passed; 0: the run has no pace.
  std::uint64_t missed = 0;     ///< Of these. Steps that were due and never done are among them.
  std::int64_t worst_ns = 0;    ///< The latest end of a step, or of none, after its deadline.
  std::uint64_t stops = 0;      ///< How often real robots were stopped for that.
  /// Missed deadlines by the phase that took the most time since a step was last in time.
  std::map<std::string, std::uint64_t> blame;

  [[nodiscard]] double missed_pct() const noexcept {
    return deadlines == 0 ? 0
                          : 100.0 * static_cast<double>(missed) / static_cast<double>(deadlines);
  }
  /// The phase with most of the blame, of equal ones the first by name; empty: nothing was missed.
  [[nodiscard]] std::string_view worst_phase() const noexcept;
  /// What another process of the same run has missed is added.
  LatenessFacts& operator+=(const LatenessFacts& other);
  friend bool operator==(const LatenessFacts&, const LatenessFacts&) = default;
};

/// Whether a phase of this name can be to blame.
[[nodiscard]] bool is_late_phase(std::string_view name) noexcept;

/// Such as `12 of 1000 missed (1.2 %), by up to 0.034 s: decide 10, machine 2`.
[[nodiscard]] std::string lateness_text(const LatenessFacts& facts);

/// Counts the deadlines of a loop that makes steps by the clock on the wall, and finds out what the
/// time went into. It reads no clock: each call is told the time. One owner thread.
class Lateness {
 public:
  using Clock = std::chrono::steady_clock;

  /// What a loop does beside the phases of the engine.
  enum class Part : std::uint8_t {
    kMachine,    ///< The loop was due, and the machine did not let it run.
    kRequests,   ///< What people asked of the run.
    kExchange,   ///< Messages of other processes, or waiting for them.
    kRecord,     ///< The record.
    kOnlookers,  ///< Results, pictures, ROS 2, shadows.
  };

  /// `period`: wall time from one step to the next, above 0; 0: no pace, and nothing is counted.
  explicit Lateness(Clock::duration period) noexcept : period_(period) {}

  /// The loop has slept until `due`, or has not slept since that was past, and goes on at `now`.
  void woke(Clock::time_point due, Clock::time_point now) noexcept;
  /// From the last call until `now` it did this.
  void did(Part part, Clock::time_point now) noexcept;
  /// ... or the engine worked; `total`: its phase_times(), which are told apart.
  void worked(const sim::PhaseTimes& total, Clock::time_point now) noexcept;
  /// The step that was due at the time of the last woke() is done. True: in time.
  bool done(Clock::time_point now);
  /// A real robot stands since steps come late.
  void stopped() noexcept { ++facts_.stops; }
  /// The loop ends at `now`: steps that were due until then and not done are missed. `last`: when
  /// the last step of the run is due.
  void end(Clock::time_point last, Clock::time_point now);

  /// How old the moment is that the step under way is for.
  [[nodiscard]] Clock::duration age(Clock::time_point now) const noexcept;
  /// How far a step that ends at `now` would be behind its deadline; 0: it is in time.
  [[nodiscard]] Clock::duration behind(Clock::time_point now) const noexcept;
  [[nodiscard]] const LatenessFacts& facts() const noexcept { return facts_; }
  /// The phase that takes the most time since a step was last in time.
  [[nodiscard]] std::string_view busiest() const noexcept;

 private:
  static constexpr std::size_t kParts = sim::kPhases + 5;
  void miss(std::uint64_t count, Clock::duration by);

  Clock::duration period_;
  Clock::time_point due_{};    ///< Of the step under way.
  Clock::time_point since_{};  ///< Of the last call.
  sim::PhaseTimes worked_{};
  std::array<std::int64_t, kParts> spent_ns_{};  ///< Since a step was last in time.
  LatenessFacts facts_;
};

}  // namespace rave::runtime
