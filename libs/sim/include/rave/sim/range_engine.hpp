// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/sim/virtual_sensor.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// The fan of one sensor, prepared once: where each ray points in the sensor frame.
struct FanTable {
  std::vector<double> cos;
  std::vector<double> sin;
  std::uint32_t rays_per_reading = 1;
  double range_min_m = 0;
  double range_max_m = 0;
  LayerMask layers = kAllLayers;

  [[nodiscard]] static FanTable make(const FanQuery& query, LayerMask layers);
  [[nodiscard]] std::uint32_t rays() const noexcept {
    return static_cast<std::uint32_t>(cos.size());
  }
  [[nodiscard]] std::uint32_t readings() const noexcept { return rays() / rays_per_reading; }
};

/// What one thread needs to cast fans; kept between calls so that nothing is allocated.
struct FanScratch {
  std::vector<std::uint32_t> found;
  std::vector<Vec2> vertices_S;
  std::vector<double> inverse;      ///< Largest 1/range of each ray so far; 0: nothing.
  std::vector<std::uint32_t> body;  ///< Whose it is.
};

/// Casts one fan from X_WS at height `z_m`. `ranges` and `bodies` have one place per reading; a ray
/// that meets nothing reads +infinity and no body. `owner` is not seen. A sensor inside a body
/// reads 0 in all directions (then range_min). Any thread, each with its own scratch.
///
/// In the sensor frame a line n.p = c is met by the ray (cos, sin) at 1/range = (n_x cos + n_y
/// sin)/c. A convex polygon is met where that is least over its edges that face the sensor, for the
/// rays between its two silhouette vertices; the nearest of all bodies is the largest of those.
void cast_fan(const world::Snapshot& world, const FanTable& fan, const Pose2& X_WS, double z_m,
              BodyId owner, FanScratch& scratch, std::span<float> ranges,
              std::span<std::uint32_t> bodies);

}  // namespace rave::sim
