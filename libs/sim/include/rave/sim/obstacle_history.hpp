// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "rave/sim/obstacle_change.hpp"

namespace rave::sim {

/// A minimal list of changes that leads from the initial obstacles of a run to the present ones: an
/// obstacle that moved a thousand times has one entry. For processes that join later. A value; one
/// owner thread.
class ObstacleHistory {
 public:
  ObstacleHistory() = default;
  /// `changes`: those of another history, which replace `count` original changes.
  ObstacleHistory(const std::vector<ObstacleChange>& changes, std::uint64_t count);

  /// Adds a change that was made; its id is set. `asked` is not kept.
  void add(const ObstacleChange& change);

  /// The number of changes so far.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Applied in order to the initial world, they lead to the present obstacles. Empty only if there
  /// was no change.
  [[nodiscard]] const std::vector<ObstacleChange>& changes() const noexcept { return changes_; }

 private:
  std::vector<ObstacleChange> changes_;
  /// By obstacle id: index of the entry with its present pose.
  std::map<std::uint32_t, std::size_t> entry_of_;
  std::uint64_t count_ = 0;
};

}  // namespace rave::sim
