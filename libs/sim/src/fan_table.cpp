// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "fan_kernel.hpp"
#include "rave/math/scalar.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {
namespace {

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
  fan.field = field_of(query);
  constexpr std::uint32_t kMostIndexed = 0xffff;
  if (fan.rays > kFewRays && fan.rays <= kMostIndexed) fan.first_ray = index_of(fan);
  return fan;
}

}  // namespace rave::sim
