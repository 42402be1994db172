// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "rave/sim/obstacle_change.hpp"

namespace rave::sim {

/// How the obstacles of a run came to stand where they stand, in as few changes as say it: an
/// obstacle that moved a thousand times is there once. For whoever was not there. A value; one
/// owner thread.
class ObstacleHistory {
 public:
  ObstacleHistory() = default;
  /// `changes`: those of another history, which `count` changes had led to.
  ObstacleHistory(const std::vector<ObstacleChange>& changes, std::uint64_t count);

  /// A change that was made; it has its number. What was asked is not kept.
  void add(const ObstacleChange& change);

  /// How many changes were made so far.
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  /// Made one after the other in the world of the start, they lead to the same obstacles. Empty
  /// only if there was no change.
  [[nodiscard]] const std::vector<ObstacleChange>& changes() const noexcept { return changes_; }

 private:
  std::vector<ObstacleChange> changes_;
  std::map<std::uint32_t, std::size_t> entry_of_;  ///< By id: what says where it stands.
  std::uint64_t count_ = 0;
};

}  // namespace rave::sim
