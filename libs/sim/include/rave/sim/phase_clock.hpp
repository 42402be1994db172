// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rave::sim {

/// The phases of a step, in order. The radio works before and after decide.
enum class Phase : std::uint8_t { kIngest, kSense, kRadio, kDecide, kAct, kResolve, kPublish };
inline constexpr std::size_t kPhases = 7;

[[nodiscard]] constexpr std::string_view to_string(Phase phase) noexcept {
  constexpr std::array<std::string_view, kPhases> kNames = {"ingest", "sense",   "radio",  "decide",
                                                            "act",    "resolve", "publish"};
  return kNames[static_cast<std::size_t>(phase)];
}

/// Returns nanoseconds of a monotonic clock. The engine has no clock of its own, because no result
/// may depend on one; a benchmark supplies one to measure the phases.
using PhaseClock = std::int64_t (*)() noexcept;

/// Total time of each phase in nanoseconds of the clock, since the engine was created or reset.
struct PhaseTimes {
  std::array<std::int64_t, kPhases> ns{};

  [[nodiscard]] std::int64_t of(Phase phase) const noexcept {
    return ns[static_cast<std::size_t>(phase)];
  }
};

/// Measures the phases of one step. Without a clock it does nothing.
class PhaseTimer {
 public:
  /// Begins the first phase. `times` must outlive the timer.
  PhaseTimer(PhaseClock clock, PhaseTimes& times) noexcept
      : clock_(clock), times_(&times), begin_ns_(clock == nullptr ? 0 : clock()) {}

  /// Ends a phase and begins the next one.
  void ends(Phase phase) noexcept {
    if (clock_ == nullptr) return;
    const std::int64_t now_ns = clock_();
    times_->ns[static_cast<std::size_t>(phase)] += now_ns - begin_ns_;
    begin_ns_ = now_ns;
  }

 private:
  PhaseClock clock_;
  PhaseTimes* times_;
  std::int64_t begin_ns_;
};

}  // namespace rave::sim
