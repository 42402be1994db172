// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <set>

#include "rave/base/result.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::manager {

/// How fast and how much obstacles may change by hand, so that nobody drowns a run, and whoever
/// comes late can be told of all in one message. One owner thread.
class EditLimits {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kPerSecond = 200;  ///< And as many at once after a quiet second.
  static constexpr double kBytesPerSecond = 4e6;
  static constexpr std::size_t kMostOpen = 4096;  ///< That wait for the next step.
  /// Two for an obstacle that came, one for others that changed.
  static constexpr std::size_t kMostEntries = 60'000;

  /// Whether one more may be asked for now; then it is counted. Errors: kState (too fast; too many
  /// or too much in all), kInvalidArgument (what lock_step::check_fits() says).
  Status take(const sim::ObstacleChange& change, Clock::time_point now);
  /// Those that were taken have been made, or refused.
  void step_done() noexcept { open_ = 0; }
  /// It was made: by hand, by the scenario, or before this manager was there.
  void made(const sim::ObstacleChange& change);

 private:
  double edits_ = kPerSecond;  ///< That may come at once.
  double bytes_ = kBytesPerSecond;
  Clock::time_point filled_{};
  std::size_t open_ = 0;
  std::size_t entries_ = 0;
  std::size_t all_bytes_ = 0;
  std::set<std::uint32_t> changed_;
};

/// Whether what a scenario says of obstacles fits into these limits and onto the bus. Errors:
/// kInvalidArgument.
[[nodiscard]] Status check_scheduled(const sim::EngineSpec& spec);

}  // namespace rave::manager
