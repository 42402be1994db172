// SPDX-License-Identifier: Apache-2.0
// Readings of range sensors: gather what is near, cast the rays, reduce them to readings.
// docs/explanation/ranges.md has the algorithm; the arithmetic is in fan_kernel.cpp and
// block_kernel.cpp.
#include "rave/sim/range_engine.hpp"

#include <algorithm>

#include "candidates.hpp"
#include "fan_casts.hpp"
#include "listed_fan.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

/// Casts the rays of the fan at what has been gathered in the scratch.
FanView cast_rays(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                  FanScratch& scratch) {
  return cast_rays(world, fan, place, {scratch.discs.data(), scratch.disc_count},
                   {scratch.polygons.data(), scratch.polygon_count}, scratch);
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

/// The approximate cost of finding candidates and of testing rays against them, in nanoseconds.
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

}  // namespace rave::sim
