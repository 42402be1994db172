// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rave::sim {

/// The phases of a step, in their order. The radio works before and after decide.
enum class Phase : std::uint8_t { kIngest, kSense, kRadio, kDecide, kAct, kResolve, kPublish };
inline constexpr std::size_t kPhases = 7;

[[nodiscard]] constexpr std::string_view to_string(Phase phase) noexcept {
  constexpr std::array<std::string_view, kPhases> kNames = {"ingest", "sense",   "radio",  "decide",
                                                            "act",    "resolve", "publish"};
  return kNames[static_cast<std::size_t>(phase)];
}

/// Nanoseconds since some fixed moment, never decreasing. The engine has no clock of its own, since
/// nothing in a run may depend on one; a benchmark lends it one to be told where the time goes.
using PhaseClock = std::int64_t (*)() noexcept;

/// What the steps of an engine took, by phase: nanoseconds of the clock, added up since the engine
/// was made or reset.
struct PhaseTimes {
  std::array<std::int64_t, kPhases> ns{};

  [[nodiscard]] std::int64_t of(Phase phase) const noexcept {
    return ns[static_cast<std::size_t>(phase)];
  }
};

/// Notes the phases of one step as they end. Without a clock it does nothing.
class PhaseTimer {
 public:
  /// The first phase begins now. `times` outlives the timer.
  PhaseTimer(PhaseClock clock, PhaseTimes& times) noexcept
      : clock_(clock), times_(&times), begin_ns_(clock == nullptr ? 0 : clock()) {}

  /// A phase ends, and the next one begins.
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
