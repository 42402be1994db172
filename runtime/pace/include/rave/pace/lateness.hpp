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

/// Missed deadlines of a run with a pace. A step is due at its wall time; its deadline is the due
/// time of the next step.
struct LatenessFacts {
  std::uint64_t deadlines = 0;  ///< Number of passed deadlines; 0: the run has no pace.
  /// Number of missed ones, including steps that were due and never done.
  std::uint64_t missed = 0;
  std::int64_t worst_ns = 0;  ///< The largest delay of a step after its deadline.
  std::uint64_t stops = 0;    ///< How often real robots were stopped because of lateness.
  /// Missed deadlines by the phase that took the most time since a step was last on time.
  std::map<std::string, std::uint64_t> blame;

  [[nodiscard]] double missed_pct() const noexcept {
    return deadlines == 0 ? 0
                          : 100.0 * static_cast<double>(missed) / static_cast<double>(deadlines);
  }
  /// The phase with the most missed deadlines, of equal ones the first by name; empty: nothing was
  /// missed.
  [[nodiscard]] std::string_view worst_phase() const noexcept;
  /// Adds the counts of another process of the same run.
  LatenessFacts& operator+=(const LatenessFacts& other);
  friend bool operator==(const LatenessFacts&, const LatenessFacts&) = default;
};

/// Whether this is the name of a phase in `blame`.
[[nodiscard]] bool is_late_phase(std::string_view name) noexcept;

/// A summary such as `12 of 1000 missed (1.2 %), by up to 0.034 s: decide 10, machine 2`.
[[nodiscard]] std::string lateness_text(const LatenessFacts& facts);

/// Counts the missed deadlines of a loop that follows the wall clock, and finds the phases that
/// caused them. It reads no clock: the caller passes the time. One owner thread.
class Lateness {
 public:
  using Clock = std::chrono::steady_clock;

  /// Activities of a loop besides the phases of the engine.
  enum class Part : std::uint8_t {
    kMachine,    ///< The loop was due, but the machine did not run it.
    kRequests,   ///< Requests to the run.
    kExchange,   ///< Messages of other processes, and waiting for them.
    kRecord,     ///< The recording.
    kOnlookers,  ///< Observers: results, pictures, ROS 2, shadows.
  };

  /// `period`: wall time between steps, above 0; 0: no pace, nothing is counted.
  explicit Lateness(Clock::duration period) noexcept : period_(period) {}

  /// The loop has slept until `due`, or `due` was already past; it continues at `now`.
  void woke(Clock::time_point due, Clock::time_point now) noexcept;
  /// The time since the last call was spent on `part`.
  void did(Part part, Clock::time_point now) noexcept;
  /// The time since the last call was spent in the engine; `total`: its phase_times(), which are
  /// counted separately.
  void worked(const sim::PhaseTimes& total, Clock::time_point now) noexcept;
  /// The step of the last woke() is done. Returns true if it is on time.
  bool done(Clock::time_point now);
  /// A real robot was stopped because steps are late.
  void stopped() noexcept { ++facts_.stops; }
  /// The loop ends at `now`: steps that were due and not done count as missed. `last`: due time of
  /// the last step of the run.
  void end(Clock::time_point last, Clock::time_point now);

  /// How old the time of the current step is.
  [[nodiscard]] Clock::duration age(Clock::time_point now) const noexcept;
  /// How far after its deadline a step that ends at `now` would be; 0: on time.
  [[nodiscard]] Clock::duration behind(Clock::time_point now) const noexcept;
  [[nodiscard]] const LatenessFacts& facts() const noexcept { return facts_; }
  /// The phase that took the most time since a step was last on time.
  [[nodiscard]] std::string_view busiest() const noexcept;

 private:
  static constexpr std::size_t kParts = sim::kPhases + 5;
  void miss(std::uint64_t count, Clock::duration by);

  Clock::duration period_;
  Clock::time_point due_{};    ///< Due time of the current step.
  Clock::time_point since_{};  ///< Time of the last call.
  sim::PhaseTimes worked_{};
  std::array<std::int64_t, kParts> spent_ns_{};  ///< Since a step was last on time.
  LatenessFacts facts_;
};

}  // namespace rave::runtime
