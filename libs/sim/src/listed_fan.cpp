// SPDX-License-Identifier: Apache-2.0
#include "listed_fan.hpp"

#include "candidates.hpp"
#include "fan_casts.hpp"

namespace rave::sim {
namespace {

/// 1 for a listed piece that the fan could meet, or 0: without a branch, as no processor can
/// foresee it. A shape of several pieces is listed once, by any of them, and always taken.
inline unsigned in_sight(const world::ShapePiece& piece, const Surroundings& around) noexcept {
  const Vec2 apart = piece.centre_W - around.p_W;
  const double own_m = static_cast<double>(piece.radius_m) + kRounding_m;
  const double reach_m = around.reach_m + own_m;
  auto seen = static_cast<unsigned>(squared_norm(apart) <= reach_m * reach_m);
  if (around.field.limited) {
    const auto right = static_cast<unsigned>(cross(around.right_W, apart) >= -own_m);
    const auto left = static_cast<unsigned>(cross(apart, around.left_W) >= -own_m);
    seen &= around.field.beyond_half ? right | left : right & left;
  }
  return seen | static_cast<unsigned>(piece.pieces > 1);
}

/// Adds those of the listed pieces to `chosen` that the fan of this asker could meet. What the next
/// ones will be asked about, up to `last`, is fetched on the way.
void choose(const world::ShapePiece* pieces, std::span<const std::uint32_t> listed,
            const std::uint32_t* last, const Surroundings& around, std::uint16_t asker,
            BlockCandidates& chosen) noexcept {
  constexpr std::ptrdiff_t kAhead = 24;
  const world::ShapePiece** const chosen_pieces = chosen.pieces.data();
  std::uint16_t* const askers = chosen.askers.data();
  std::size_t count = chosen.count;
  for (const std::uint32_t& index : listed) {
    __builtin_prefetch(pieces + *(last - &index > kAhead ? &index + kAhead : last));
    const world::ShapePiece& piece = pieces[index];
    chosen_pieces[count] = &piece;
    askers[count] = asker;
    count += in_sight(piece, around);
  }
  chosen.count = count;
}

}  // namespace

void list_near(const world::Snapshot& world, const FanTable& fan, double z_m,
               std::span<const RobotId> owners, std::span<const Vec2> places_W, double margin_m,
               FanScratch& scratch, NearLists& lists) {
  lists.begin(world, places_W, margin_m);
  for (std::size_t i = 0; i < places_W.size(); ++i) {
    Surroundings around;
    around.p_W = places_W[i];
    around.reach_m = static_cast<double>(fan.range_max_m) + margin_m;
    collect(world, around, {fan, static_cast<float>(z_m), world.body_of(owners[i]), scratch},
            scratch);
    const auto list = [&lists](const auto& candidates, std::size_t count) {
      for (std::size_t k = 0; k < count; ++k) lists.add(candidates[k]->index);
      lists.end_list();
    };
    list(scratch.discs, scratch.disc_count);
    list(scratch.polygons, scratch.polygon_count);
  }
}

ListedFans::ListedFans(const world::Snapshot& world, const FanTable& fan, const NearLists& lists,
                       std::span<const SensorPlace> places, FanScratch& scratch,
                       BlockScratch& block)
    : world_(&world),
      fan_(&fan),
      lists_(&lists),
      places_(places),
      scratch_(&scratch),
      block_(&block) {
  if (fan.rays <= kFewRays) cast_together();
}

void ListedFans::choose_for(std::size_t asker) {
  const std::span all = lists_->all();
  if (all.empty()) return;
  const Surroundings around = what_sees(*fan_, places_[asker]);
  const auto number = static_cast<std::uint16_t>(asker);
  choose(world_->pieces(), lists_->first(asker), &all.back(), around, number, block_->discs);
  choose(world_->pieces(), lists_->second(asker), &all.back(), around, number, block_->polygons);
}

void ListedFans::forget_chosen() {
  block_->discs.clear(lists_->all().size());
  block_->polygons.clear(lists_->all().size());
}

void ListedFans::cast_together() {
  forget_chosen();
  for (std::size_t asker = 0; asker < places_.size(); ++asker) choose_for(asker);
  make_ray_room(*fan_, *scratch_);
  block_->places.clear();
  for (const SensorPlace& place : places_) block_->places.push_back(to_fan_place(place));
  const std::size_t size = fan_->cos.size();
  block_->inverse.resize(size * places_.size());
  block_->body.resize(size * places_.size());
  cast_block(block_->discs.seen_by(), block_->polygons.seen_by(), world_->vertices_W(),
             world_->normals_W(),
             {fan_->cos.data(), fan_->sin.data(), size, block_->places.data(), places_.size(),
              block_->inverse.data(), block_->body.data()});
}

void ListedFans::read(std::size_t asker, std::span<float> ranges, std::span<std::uint32_t> bodies) {
  if (fan_->rays <= kFewRays) {
    const std::size_t size = fan_->cos.size();
    read_rays(*fan_,
              {.padded = size,
               .inverse = block_->inverse.data() + asker * size,
               .body = block_->body.data() + asker * size},
              *scratch_, ranges, bodies);
    return;
  }
  forget_chosen();
  choose_for(asker);
  make_ray_room(*fan_, *scratch_);
  const FanView view = cast_rays(*world_, *fan_, places_[asker], block_->discs.seen_by().pieces,
                                 block_->polygons.seen_by().pieces, *scratch_);
  read_rays(*fan_, view, *scratch_, ranges, bodies);
}

}  // namespace rave::sim
