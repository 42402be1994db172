// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fan_kernel.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

inline FanPlace to_fan_place(const SensorPlace& place) noexcept {
  return {place.p_WS.x, place.p_WS.y, static_cast<float>(place.turn.cos),
          static_cast<float>(place.turn.sin)};
}

/// Casts the rays of the fan at the candidates; what each met stands in the scratch.
inline FanView cast_rays(const world::Snapshot& world, const FanTable& fan,
                         const SensorPlace& place, Pieces discs, Pieces polygons,
                         FanScratch& scratch) {
  const FanView view{fan.cos.data(),         fan.sin.data(),
                     fan.cos.size(),         fan.first_ray.empty() ? nullptr : fan.first_ray.data(),
                     scratch.inverse.data(), scratch.body.data()};
  cast_pieces(discs, polygons, world.vertices_W(), world.normals_W(), to_fan_place(place), view);
  return view;
}

/// Room for what rays meet.
inline void make_ray_room(const FanTable& fan, FanScratch& scratch) {
  scratch.inverse.resize(fan.cos.size());
  scratch.body.resize(fan.cos.size());
  scratch.ranges_m.resize(fan.cos.size());
}

/// Of the rays of each cone the nearest.
inline void join_cones(const FanTable& fan, const FanView& view) {
  for (std::size_t reading = 0; reading < fan.readings(); ++reading) {
    const std::size_t first = reading * fan.rays_per_reading;
    std::size_t nearest = first;
    for (std::size_t ray = first; ray < first + fan.rays_per_reading; ++ray) {
      if (view.inverse[ray] > view.inverse[nearest]) nearest = ray;
    }
    view.inverse[reading] = view.inverse[nearest];
    view.body[reading] = view.body[nearest];
  }
}

/// The readings of what the rays have met. `view` is changed.
inline void read_rays(const FanTable& fan, FanView view, FanScratch& scratch,
                      std::span<float> ranges, std::span<std::uint32_t> bodies) {
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

}  // namespace rave::sim
