// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <set>

#include "rave/base/result.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::manager {

/// Limits how fast and how much obstacles may be changed by hand, so that no one can overload a
/// run, and all changes fit into one message for a process that joins late. One owner thread.
class EditLimits {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kPerSecond =
      200;  ///< Also the largest number at once, after a second without edits.
  static constexpr double kBytesPerSecond = 4e6;
  static constexpr std::size_t kMostOpen = 4096;  ///< Edits that wait for the next step.
  /// An added obstacle counts as two entries, a changed one as one.
  static constexpr std::size_t kMostEntries = 60'000;

  /// Accepts and counts one more edit. Errors: kState (too fast; too many or too much in total),
  /// kInvalidArgument (from lock_step::check_fits()).
  Status take(const sim::ObstacleChange& change, Clock::time_point now);
  /// Call it when the accepted edits have been made or refused.
  void step_done() noexcept { open_ = 0; }
  /// Counts a change that was made: by hand, by the scenario, or under an earlier manager.
  void made(const sim::ObstacleChange& change);

 private:
  double edits_ = kPerSecond;  ///< Edits that are permitted at once now.
  double bytes_ = kBytesPerSecond;
  Clock::time_point filled_{};
  std::size_t open_ = 0;
  std::size_t entries_ = 0;
  std::size_t all_bytes_ = 0;
  std::set<std::uint32_t> changed_;
};

/// Checks that the obstacle changes of a scenario stay within these limits and fit onto the bus.
/// Errors: kInvalidArgument.
[[nodiscard]] Status check_scheduled(const sim::EngineSpec& spec);

}  // namespace rave::manager
