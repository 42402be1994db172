// SPDX-License-Identifier: Apache-2.0
// Lists of what is near, kept over several steps. The bound that they rely on is in
// docs/explanation/ranges.md.
#include "near_lists.hpp"

#include <limits>

namespace rave::sim {

double MotionWatch::look(const world::Snapshot& world) noexcept {
  // A jump, a new body or a robot that appears is not in drift_m(); the snapshot counts these by
  // generations.
  const bool jumped = generation_ != world.generation();
  const double moved_m = world.drift_m() - drift_m_;
  generation_ = world.generation();
  drift_m_ = world.drift_m();
  return jumped ? std::numeric_limits<double>::infinity() : moved_m;
}

bool NearLists::hold(const world::Snapshot& world, std::span<const Vec2> places,
                     double more_m) const noexcept {
  if (places_.size() != places.size() || generation_ != world.generation()) return false;
  // Both sides use up the margin: robots in the list by the drift since then, the asker by its own
  // motion, which may take what is left.
  const double left_m = margin_m_ - more_m - (world.drift_m() - drift_m_);
  if (left_m < 0) return false;
  bool near = true;  // and not if a place is no number
  for (std::size_t i = 0; i < places.size(); ++i) {
    near = near && squared_norm(places[i] - places_[i]) <= left_m * left_m;
  }
  return near;
}

void NearLists::begin(const world::Snapshot& world, std::span<const Vec2> places, double margin_m) {
  places_.assign(places.begin(), places.end());
  // Twice the room of last time once that is nearly used up, so that blocks soon stop growing.
  if (numbers_.size() > numbers_.capacity() / 4 * 3) numbers_.reserve(2 * numbers_.size());
  numbers_.clear();
  ends_.assign(1, 0);
  generation_ = world.generation();
  drift_m_ = world.drift_m();
  margin_m_ = margin_m;
}

}  // namespace rave::sim
