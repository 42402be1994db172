// SPDX-License-Identifier: Apache-2.0
// Where obstacles were in the past, as a list of changes that can be gone through in both
// directions.
#include "obstacle_journal.hpp"

namespace rave::sim {
namespace {

void put(world::Snapshot& world, BodyId id, const ObstacleState& state) {
  world.set_obstacle(id, state.X_WB, state.present);
}

}  // namespace

std::uint64_t ObstacleJournal::revision_at(SimTime time) const noexcept {
  std::size_t count = entries_.size();
  while (count > 0 && entries_[count - 1].from > time) --count;
  return first_ + count;
}

void ObstacleJournal::forget_before(SimTime time) {
  while (!entries_.empty() && entries_.front().from < time) {
    entries_.pop_front();
    ++first_;
  }
}

void ObstacleJournal::clear() noexcept {
  entries_.clear();
  first_ = 0;
}

// A snapshot of the past goes from the revision that it shows to the wanted one, forward or
// backward, change by change: cheaper than placing all obstacles anew.
void ObstacleJournal::show(world::Snapshot& world, std::uint64_t& shown,
                           std::uint64_t wanted) const {
  if (shown == wanted) return;
  if (shown < first_) {
    // It has missed changes that are not kept any more. What stands now is known, and the way back
    // from there.
    const world::WorldModel& model = world.model();
    for (std::size_t i = 0; i < model.obstacle_count(); ++i) {
      const std::uint32_t id = model.obstacle_id(i);
      const world::Obstacle& obstacle = *model.obstacle(id);
      put(world, BodyId(id), {obstacle.X_WB, !obstacle.removed});
    }
    shown = revision();
  }
  for (; shown < wanted; ++shown) {
    const JournalEntry& entry = entries_[shown - first_];
    put(world, entry.id, entry.after);
  }
  for (; shown > wanted; --shown) {
    const JournalEntry& entry = entries_[shown - 1 - first_];
    put(world, entry.id, entry.before);
  }
  world.index_obstacles();
}

}  // namespace rave::sim
