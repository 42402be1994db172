// SPDX-License-Identifier: Apache-2.0
#include "near_lists.hpp"

namespace rave::sim {

bool NearLists::hold(const world::Snapshot& world, std::span<const Vec2> places,
                     double more_m) const noexcept {
  if (places_.size() != places.size() || generation_ != world.generation()) return false;
  const double left_m = margin_m_ - more_m - (world.drift_m() - drift_m_);
  if (left_m < 0) return false;
  double farthest_m2 = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    farthest_m2 = std::max(farthest_m2, squared_norm(places[i] - places_[i]));
  }
  return farthest_m2 <= left_m * left_m;
}

void NearLists::begin(const world::Snapshot& world, std::span<const Vec2> places, double margin_m) {
  places_.assign(places.begin(), places.end());
  numbers_.clear();
  ends_.assign(1, 0);
  generation_ = world.generation();
  drift_m_ = world.drift_m();
  margin_m_ = margin_m;
}

}  // namespace rave::sim
