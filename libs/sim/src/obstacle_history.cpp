// SPDX-License-Identifier: Apache-2.0
// All changes of obstacles since the start, shortened to what is left of them, for a host that
// comes late.
#include "rave/sim/obstacle_history.hpp"

namespace rave::sim {

using ChangeKind = ObstacleChange::Kind;

// add() counts the changes that are left of them all.
ObstacleHistory::ObstacleHistory(const std::vector<ObstacleChange>& changes, std::uint64_t count)
    : count_(count - changes.size()) {
  for (const ObstacleChange& change : changes) add(change);
}

void ObstacleHistory::add(const ObstacleChange& change) {
  ++count_;
  const auto found = entry_of_.find(change.id.value());
  if (change.kind != ChangeKind::kAdd && found != entry_of_.end()) {
    ObstacleChange& before = changes_[found->second];
    if (change.kind == ChangeKind::kMove) {
      before.X_WB = change.X_WB;
      return;
    }
    // The number of one that was added stays taken, so its addition has to be reported, too.
    if (before.kind == ChangeKind::kMove) {
      before.kind = ChangeKind::kRemove;
      return;
    }
  }
  if (change.kind != ChangeKind::kRemove) entry_of_[change.id.value()] = changes_.size();
  changes_.push_back(change);
  changes_.back().asked.clear();
}

}  // namespace rave::sim
