// SPDX-License-Identifier: Apache-2.0
// Readings of range sensors: gather what is near, cast the rays, reduce them to readings.
// docs/explanation/ranges.md has the algorithm; the arithmetic is in fan_kernel.cpp and
// block_kernel.cpp.
#include "rave/sim/range_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "block_kernel.hpp"
#include "fan_kernel.hpp"
#include "listed_fan.hpp"
#include "near_kernel.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

std::size_t padded(std::size_t count) noexcept {
  return (count + kRayPadding - 1) / kRayPadding * kRayPadding;
}

/// For each bucket of the bearing the first ray that does not lie before it; empty if the rays are
/// in no order.
std::vector<std::uint16_t> index_of(const FanTable& fan) {
  std::vector<std::uint16_t> first_ray(kBearingBuckets + 1, static_cast<std::uint16_t>(fan.rays));
  std::size_t next = 0;
  float before = -1;
  for (std::uint32_t ray = 0; ray < fan.rays; ++ray) {
    const float scale = bearing_scale(fan.cos[ray], fan.sin[ray]);
    // The index needs rays in order. Fans of drivers with another order work without it, only
    // slower.
    if (scale < before) return {};
    before = scale;
    for (const std::size_t bucket = bearing_bucket(scale); next <= bucket; ++next) {
      first_ray[next] = static_cast<std::uint16_t>(ray);
    }
  }
  return first_ray;
}

/// What lies between the first and the last ray, if they go counter-clockwise.
FanField field_of(const FanQuery& query) {
  // With less left open than this, there is nothing worth leaving out.
  constexpr double kLeastOpen_rad = 0.5;
  FanField field;
  const double* const bearings_rad = query.bearings_rad;
  if (query.ray_count == 0 || !std::is_sorted(bearings_rad, bearings_rad + query.ray_count)) {
    return field;
  }
  const double right_rad = bearings_rad[0];
  const double left_rad = bearings_rad[query.ray_count - 1];
  field.limited = left_rad - right_rad < 2 * kPi - kLeastOpen_rad;
  field.beyond_half = left_rad - right_rad > kPi;
  field.part = field.limited ? (left_rad - right_rad) / (2 * kPi) : 1;
  field.right = sincos(right_rad);
  field.left = sincos(left_rad);
  return field;
}

/// Up to here from the grid's origin the floats of PieceColumns are fine enough to choose by.
/// Below this, a place is rounded by at most 2^-14 m (0.06 mm), well below kRounding_m.
constexpr double kFloatReach_m = 2048;
/// So much farther than the range candidates may lie, as PieceColumns have it.
constexpr double kRounding_m = 1e-3;

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

Surroundings what_sees(const FanTable& fan, const SensorPlace& place) noexcept {
  return {place.p_WS, static_cast<double>(fan.range_max_m), fan.field,
          rotate(place.turn, {fan.field.right.cos, fan.field.right.sin}),
          rotate(place.turn, {fan.field.left.cos, fan.field.left.sin})};
}

/// Room for so many more candidates of each kind.
void make_room(FanScratch& scratch, std::size_t count) {
  const auto grow = [](std::vector<const world::ShapePiece*>& list, std::size_t size) {
    if (list.size() < size) list.resize(size);
  };
  grow(scratch.discs, scratch.disc_count + count);
  grow(scratch.polygons, scratch.polygon_count + count);
}

/// Adds the pieces of a grid that lie in the surroundings.
void collect(const world::ShapeGrid& grid, const Surroundings& around, Candidates& candidates,
             FanScratch& scratch) {
  const world::PieceColumns columns = grid.columns();
  const Vec2 p = around.p_W - columns.origin;
  // Written so that a place that is not a number takes this way, too.
  if (!(std::abs(p.x) < kFloatReach_m && std::abs(p.y) < kFloatReach_m)) {
    grid.for_each_near(around.p_W, around.reach_m + kRounding_m,
                       [&](const world::ShapePiece& piece) {
                         make_room(scratch, 1);
                         candidates.add(piece);
                       });
    return;
  }
  if (scratch.near.size() < grid.size() + world::kPiecePadding) {
    scratch.near.resize(grid.size() + world::kPiecePadding);
  }
  const NearField field{static_cast<float>(p.x),
                        static_cast<float>(p.y),
                        static_cast<float>(around.reach_m),
                        around.field,
                        static_cast<float>(around.right_W.x),
                        static_cast<float>(around.right_W.y),
                        static_cast<float>(around.left_W.x),
                        static_cast<float>(around.left_W.y)};
  const std::size_t count =
      select_near(grid, grid.cells_near(around.p_W, around.reach_m), field, scratch.near.data());
  // One more than needed: add() writes each piece to both lists and then counts it in one.
  make_room(scratch, count + 1);
  for (std::size_t i = 0; i < count; ++i) candidates.add(grid.piece(scratch.near[i]));
}

/// Of what is equally near the first is seen: that must not depend on how it was found. Each shape
/// once.
void put_in_order(FanScratch& scratch) {
  const auto order = [](std::vector<const world::ShapePiece*>& list, std::size_t& count) {
    const auto begin = list.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    std::sort(begin, end, [](const auto* a, const auto* b) { return a->shape < b->shape; });
    const auto last =
        std::unique(begin, end, [](const auto* a, const auto* b) { return a->shape == b->shape; });
    count = static_cast<std::size_t>(last - begin);
  };
  order(scratch.discs, scratch.disc_count);
  order(scratch.polygons, scratch.polygon_count);
}

void collect(const world::Snapshot& world, const Surroundings& around, Candidates candidates,
             FanScratch& scratch) {
  collect(world.standing(), around, candidates, scratch);
  collect(world.moving(), around, candidates, scratch);
  put_in_order(scratch);
}

/// 1 for a listed piece that the fan could meet, or 0: without a branch, as no processor can
/// foresee it. A shape of several pieces is listed once, by any of them, and always taken.
inline unsigned in_sight(const world::ShapePiece& piece, const Surroundings& around) noexcept {
  const Vec2 apart = piece.centre_W - around.p_W;
  // The edges of the field are unit vectors, so a cross product is the distance from the edge.
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

/// Of the rays of each cone the nearest.
void join_cones(const FanTable& fan, const FanView& view) {
  for (std::size_t reading = 0; reading < fan.readings(); ++reading) {
    const std::size_t first = reading * fan.rays_per_reading;
    std::size_t nearest = first;
    for (std::size_t ray = first; ray < first + fan.rays_per_reading; ++ray) {
      // Readings are written in front of rays that are still to be read: reading <= first holds.
      if (view.inverse[ray] > view.inverse[nearest]) nearest = ray;
    }
    view.inverse[reading] = view.inverse[nearest];
    view.body[reading] = view.body[nearest];
  }
}

}  // namespace

FanTable FanTable::make(const FanQuery& query, LayerMask layers) {
  FanTable fan;
  fan.rays = query.ray_count;
  fan.rays_per_reading = query.rays_per_reading;
  fan.range_min_m = static_cast<float>(query.range_min_m);
  fan.range_max_m = static_cast<float>(query.range_max_m);
  fan.layers = layers;
  // Padding has the direction (0, 0). It meets discs and polygons at 1/range = 0: never.
  fan.cos.resize(padded(query.ray_count));
  fan.sin.resize(padded(query.ray_count));
  for (std::uint32_t i = 0; i < query.ray_count; ++i) {
    const SinCos bearing = sincos(query.bearings_rad[i]);
    fan.cos[i] = static_cast<float>(bearing.cos);
    fan.sin[i] = static_cast<float>(bearing.sin);
  }
  fan.field = field_of(query);
  constexpr std::uint32_t kMostIndexed = 0xffff;
  if (fan.rays > kFewRays && fan.rays <= kMostIndexed) fan.first_ray = index_of(fan);
  return fan;
}

namespace {

FanPlace to_fan_place(const SensorPlace& place) noexcept {
  return {place.p_WS.x, place.p_WS.y, static_cast<float>(place.turn.cos),
          static_cast<float>(place.turn.sin)};
}

/// Casts the rays of the fan at the candidates; what each met stands in the scratch.
FanView cast_rays(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                  Pieces discs, Pieces polygons, FanScratch& scratch) {
  const FanView view{fan.cos.data(),         fan.sin.data(),
                     fan.cos.size(),         fan.first_ray.empty() ? nullptr : fan.first_ray.data(),
                     scratch.inverse.data(), scratch.body.data()};
  cast_pieces(discs, polygons, world.vertices_W(), world.normals_W(), to_fan_place(place), view);
  return view;
}

/// The same at what has been gathered in the scratch.
FanView cast_rays(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                  FanScratch& scratch) {
  return cast_rays(world, fan, place, {scratch.discs.data(), scratch.disc_count},
                   {scratch.polygons.data(), scratch.polygon_count}, scratch);
}

/// Room for what rays meet.
void make_ray_room(const FanTable& fan, FanScratch& scratch) {
  scratch.inverse.resize(fan.cos.size());
  scratch.body.resize(fan.cos.size());
  scratch.ranges_m.resize(fan.cos.size());
}

/// The readings of what the rays have met. `view` is changed.
void read_rays(const FanTable& fan, FanView view, FanScratch& scratch, std::span<float> ranges,
               std::span<std::uint32_t> bodies) {
  if (fan.rays_per_reading > 1) {
    join_cones(fan, view);
    view.padded = padded(ranges.size());
  }
  const RangeLimits limits{fan.range_min_m, fan.range_max_m};
  if (ranges.size() == view.padded && bodies.size() == view.padded) {
    finish_ranges(view, limits, ranges.data(), bodies.data());
    return;
  }
  finish_ranges(view, limits, scratch.ranges_m.data(), view.body);
  std::copy_n(scratch.ranges_m.begin(), ranges.size(), ranges.begin());
  std::copy_n(view.body, bodies.size(), bodies.begin());
}

/// Casts the fan at the candidates.
void cast_candidates(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                     FanScratch& scratch, std::span<float> ranges,
                     std::span<std::uint32_t> bodies) {
  make_ray_room(fan, scratch);
  read_rays(fan, cast_rays(world, fan, place, scratch), scratch, ranges, bodies);
}

/// Adds the pieces that lie beside one part of a ray.
void collect_along(const world::Snapshot& world, Vec2 p_W, Vec2 direction,
                   const world::RayParts& part, Candidates& candidates, FanScratch& scratch) {
  // The kernel has directions in floats.
  constexpr double kDirection = 1e-6;
  world.for_each_along(p_W, direction, part.from_m, part.to_m, kRounding_m + kDirection * part.to_m,
                       [&](const world::ShapePiece& piece) {
                         make_room(scratch, 1);
                         candidates.add(piece);
                       });
}

/// What looking for candidates, and trying the rays at them, takes: about so many nanoseconds.
struct LookCost {
  double around = 0;
  double along = 0;
};

LookCost cost_of(const world::Snapshot& world, const FanTable& fan) noexcept {
  // Measured by `bench_parts --benchmark_filter=ray_walk`.
  constexpr double kSelect = 0.6;     // a piece of the rows about the sensor
  constexpr double kBeside = 3;       // a piece of the cells beside a ray
  constexpr double kCandidate = 20;   // to try up to 16 rays at one
  constexpr double kPart = 60;        // to begin with a part of a ray
  constexpr double kRow = 8;          // a row of cells
  constexpr double kFreePaths = 2.5;  // few rays go farther
  const auto range_m = static_cast<double>(fan.range_max_m);
  const double length_m = std::min(range_m, kFreePaths * world.first_part_m());
  LookCost cost;
  double met = 0;
  for (const world::ShapeGrid* const grid : {&world.standing(), &world.moving()}) {
    const auto size = static_cast<double>(grid->size());
    const double reach_m = range_m + grid->largest_radius_m();
    // select_near() looks at the rows of a square about the sensor; only those in the disc become
    // candidates.
    const double pieces = std::min(size, 4 * reach_m * reach_m * grid->pieces_per_m2());
    const double disc = std::min(size, kPi * reach_m * reach_m * grid->pieces_per_m2());
    const double most_rows = grid->rows();
    const double rows_around = std::min(most_rows, 2 * reach_m / grid->cell_m() + 1);
    cost.around += kSelect * pieces + kCandidate * fan.field.part * disc + kRow * rows_around;
    const double width_m = 2 * (grid->largest_radius_m() + grid->cell_m());
    // A ray of any direction rises by 2 / pi of its length.
    const double rows_beside =
        std::min(most_rows, (0.64 * length_m + 2 * grid->largest_radius_m()) / grid->cell_m() + 1);
    cost.along +=
        kBeside * std::min(size, width_m * length_m * grid->pieces_per_m2()) + kRow * rows_beside;
    // Expected number of discs that a line of this length meets: its mean free path is 1 / (2 r n).
    met += 2 * grid->mean_radius_m() * length_m * grid->pieces_per_m2();
  }
  cost.along = fan.rays * (kPart + cost.along + kCandidate * met);
  return cost;
}

}  // namespace

bool walk_pays(const world::Snapshot& world, const FanTable& fan) noexcept {
  if (fan.rays > kMostWalked) return false;
  const LookCost cost = cost_of(world, fan);
  return cost.along < cost.around;
}

void cast_fan_around(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                     double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
                     std::span<std::uint32_t> bodies) {
  collect(world, what_sees(fan, place), {fan, static_cast<float>(z_m), owner, scratch}, scratch);
  cast_candidates(world, fan, place, scratch, ranges, bodies);
}

void cast_fan_along(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                    double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
                    std::span<std::uint32_t> bodies) {
  make_ray_room(fan, scratch);
  Candidates candidates(fan, static_cast<float>(z_m), owner, scratch);
  std::uint32_t open = (1U << fan.rays) - 1;  // rays that have met nothing in the parts behind
  world::RayParts part = world.parts_of(place.p_WS, static_cast<double>(fan.range_max_m));
  while (open != 0 && part.next()) {
    for (std::uint32_t ray = 0; ray < fan.rays; ++ray) {
      if ((open >> ray & 1U) == 0) continue;
      const Vec2 direction = rotate(
          place.turn, {static_cast<double>(fan.cos[ray]), static_cast<double>(fan.sin[ray])});
      collect_along(world, place.p_WS, direction, part, candidates, scratch);
    }
    put_in_order(scratch);
    // After the last part all candidates are known, and the cast behind the loop is the final one.
    if (!(part.to_m < part.end_m)) break;
    cast_rays(world, fan, place, scratch);
    // A hit farther than this could still be hidden by a piece of the next part. The margins cover
    // the rounding of places and directions; range <= sure_m is tested without a division.
    const double sure_m = part.to_m - 2 * kRounding_m - 1e-6 * part.to_m;
    for (std::uint32_t ray = 0; ray < fan.rays; ++ray) {
      if (static_cast<double>(scratch.inverse[ray]) * sure_m >= 1) open &= ~(1U << ray);
    }
  }
  cast_candidates(world, fan, place, scratch, ranges, bodies);
}

void cast_fan(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
              double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
              std::span<std::uint32_t> bodies) {
  const auto cast = walk_pays(world, fan) ? cast_fan_along : cast_fan_around;
  cast(world, fan, place, z_m, owner, scratch, ranges, bodies);
}

void list_near(const world::Snapshot& world, const FanTable& fan, double z_m,
               std::span<const RobotId> owners, std::span<const Vec2> places_W, double margin_m,
               FanScratch& scratch, NearLists& lists) {
  lists.begin(world, places_W, margin_m);
  for (std::size_t i = 0; i < places_W.size(); ++i) {
    Surroundings around;
    // No field: robots turn while the list holds, so it has what is near on all sides.
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
  // Cast with the whole block already; fans of many rays are cast when they are read.
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
