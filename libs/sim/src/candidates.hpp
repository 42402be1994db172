// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "rave/sim/range_engine.hpp"

namespace rave::sim {

/// So much farther than the range candidates may lie, as PieceColumns have it.
inline constexpr double kRounding_m = 1e-3;

/// Adds candidates to a scratch, each shape once.
class Candidates {
 public:
  Candidates(const FanTable& fan, float z_m, BodyId owner, FanScratch& scratch)
      : scratch_(&scratch), owner_(owner.value()), layers_(fan.layers), z_m_(z_m) {
    scratch.disc_count = 0;
    scratch.polygon_count = 0;
  }

  /// Without branches that are hard to foresee: each goes to the end of its list, and counts or
  /// not. There must be room.
  void add(const world::ShapePiece& piece) noexcept {
    const auto seen = static_cast<unsigned>(piece.body != owner_) &
                      static_cast<unsigned>(piece.in_layers(layers_)) &
                      static_cast<unsigned>(piece.z0_m <= z_m_) &
                      static_cast<unsigned>(piece.z1_m >= z_m_);
    if (piece.pieces > 1 && is_known(piece.shape)) return;
    const auto disc = static_cast<unsigned>(piece.vertex_count == 0);
    scratch_->discs[scratch_->disc_count] = &piece;
    scratch_->disc_count += seen & disc;
    scratch_->polygons[scratch_->polygon_count] = &piece;
    scratch_->polygon_count += seen & (disc ^ 1U);
  }

 private:
  /// Only polygons have several pieces.
  [[nodiscard]] bool is_known(std::uint32_t shape) const noexcept {
    const auto begin = scratch_->polygons.begin();
    return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(scratch_->polygon_count),
                       [&](const auto* other) { return other->shape == shape; });
  }

  FanScratch* scratch_;
  std::uint32_t owner_;
  LayerMask layers_;
  float z_m_;
};

/// Where to look for candidates: as far as `reach_m` around p_W, in `field`, whose edges point to
/// `right_W` and `left_W`.
struct Surroundings {
  Vec2 p_W;
  double reach_m = 0;
  FanField field;
  Vec2 right_W;
  Vec2 left_W;
};

inline Surroundings what_sees(const FanTable& fan, const SensorPlace& place) noexcept {
  return {place.p_WS, static_cast<double>(fan.range_max_m), fan.field,
          rotate(place.turn, {fan.field.right.cos, fan.field.right.sin}),
          rotate(place.turn, {fan.field.left.cos, fan.field.left.sin})};
}

/// Room for this number of further candidates of each kind.
inline void make_room(FanScratch& scratch, std::size_t count) {
  const auto grow = [](std::vector<const world::ShapePiece*>& list, std::size_t size) {
    if (list.size() < size) list.resize(size);
  };
  grow(scratch.discs, scratch.disc_count + count);
  grow(scratch.polygons, scratch.polygon_count + count);
}

/// Of what is equally near the first is seen: that must not depend on how it was found. Each shape
/// once.
void put_in_order(FanScratch& scratch);

/// Adds the pieces of the world that lie in the surroundings, in order.
void collect(const world::Snapshot& world, const Surroundings& around, Candidates candidates,
             FanScratch& scratch);

}  // namespace rave::sim
