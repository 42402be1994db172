// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/range_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fan_kernel.hpp"
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
    if (scale < before) return {};
    before = scale;
    for (const std::size_t bucket = bearing_bucket(scale); next <= bucket; ++next) {
      first_ray[next] = static_cast<std::uint16_t>(ray);
    }
  }
  return first_ray;
}

/// Up to here from the grid's origin the floats of PieceColumns are fine enough to choose by.
constexpr double kFloatReach_m = 2048;

/// Adds the pieces of a grid that the fan could meet, each shape once.
void collect(const world::ShapeGrid& grid, const FanTable& fan, Vec2 p_WS, float z_m, BodyId owner,
             FanScratch& scratch) {
  std::vector<const world::ShapePiece*>& pieces = scratch.pieces;
  const auto consider = [&](const world::ShapePiece& piece) {
    if (piece.body == owner.value() || !piece.in_layers(fan.layers) || !piece.at_height(z_m)) {
      return;
    }
    if (piece.pieces > 1) {
      const bool known = std::any_of(pieces.rbegin(), pieces.rend(), [&](const auto* other) {
        return other->shape == piece.shape;
      });
      if (known) return;
    }
    pieces.push_back(&piece);
  };
  const world::PieceColumns columns = grid.columns();
  const Vec2 p = p_WS - columns.origin;
  const auto range_m = static_cast<double>(fan.range_max_m);
  if (!(std::abs(p.x) < kFloatReach_m && std::abs(p.y) < kFloatReach_m)) {
    grid.for_each_near(p_WS, range_m, consider);
    return;
  }
  scratch.rows.clear();
  grid.add_rows_near(p_WS, range_m, scratch.rows);
  std::size_t most = world::kPiecePadding;
  for (const world::PieceRow& row : scratch.rows) most += row.end - row.begin;
  if (scratch.near.size() < most) scratch.near.resize(most);
  const std::size_t count =
      select_near(columns, scratch.rows, static_cast<float>(p.x), static_cast<float>(p.y),
                  fan.range_max_m, scratch.near.data());
  for (std::size_t i = 0; i < count; ++i) consider(grid.piece(scratch.near[i]));
}

/// Of the rays of each cone the nearest.
void join_cones(const FanTable& fan, FanScratch& scratch) {
  for (std::size_t reading = 0; reading < fan.readings(); ++reading) {
    const std::size_t first = reading * fan.rays_per_reading;
    std::size_t nearest = first;
    for (std::size_t ray = first; ray < first + fan.rays_per_reading; ++ray) {
      if (scratch.inverse[ray] > scratch.inverse[nearest]) nearest = ray;
    }
    scratch.inverse[reading] = scratch.inverse[nearest];
    scratch.body[reading] = scratch.body[nearest];
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
  fan.cos.resize(padded(query.ray_count));
  fan.sin.resize(padded(query.ray_count));
  for (std::uint32_t i = 0; i < query.ray_count; ++i) {
    const SinCos bearing = sincos(query.bearings_rad[i]);
    fan.cos[i] = static_cast<float>(bearing.cos);
    fan.sin[i] = static_cast<float>(bearing.sin);
  }
  constexpr std::uint32_t kMostIndexed = 0xffff;
  if (fan.rays > kFewRays && fan.rays <= kMostIndexed) fan.first_ray = index_of(fan);
  return fan;
}

void cast_fan(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
              double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
              std::span<std::uint32_t> bodies) {
  scratch.pieces.clear();
  collect(world.standing(), fan, place.p_WS, static_cast<float>(z_m), owner, scratch);
  collect(world.moving(), fan, place.p_WS, static_cast<float>(z_m), owner, scratch);
  scratch.inverse.assign(fan.cos.size(), 0.0F);
  scratch.body.assign(fan.cos.size(), BodyId::kNone);
  scratch.ranges_m.resize(fan.cos.size());
  FanView view{fan.cos.data(),         fan.sin.data(),
               fan.cos.size(),         fan.first_ray.empty() ? nullptr : fan.first_ray.data(),
               scratch.inverse.data(), scratch.body.data()};
  cast_pieces(scratch.pieces.data(), scratch.pieces.size(), world.vertices_W(), world.normals_W(),
              {place.p_WS.x, place.p_WS.y, static_cast<float>(place.turn.cos),
               static_cast<float>(place.turn.sin)},
              view);
  if (fan.rays_per_reading > 1) {
    join_cones(fan, scratch);
    view.padded = padded(ranges.size());
  }
  finish_ranges(view, fan.range_min_m, fan.range_max_m, scratch.ranges_m.data());
  std::copy_n(scratch.ranges_m.begin(), ranges.size(), ranges.begin());
  std::copy_n(scratch.body.begin(), bodies.size(), bodies.begin());
}

}  // namespace rave::sim
