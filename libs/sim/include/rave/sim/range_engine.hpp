// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// The sector that contains all rays of a fan, in the sensor frame: from `right` counter-clockwise
/// to `left`; unit vectors.
struct FanField {
  bool limited = false;      ///< False: the full circle, or unknown.
  bool beyond_half = false;  ///< More than half a circle.
  double part = 1;           ///< Fraction of a circle; 1 if not limited.
  SinCos right;
  SinCos left;
};

/// The fan of one sensor, prepared once: the directions of all rays in the sensor frame. Arrays are
/// padded for the vector kernel.
struct FanTable {
  std::vector<float> cos;
  std::vector<float> sin;
  /// Index by bearing; empty if there are few rays or they are not in order.
  std::vector<std::uint16_t> first_ray;
  std::uint32_t rays = 0;
  std::uint32_t rays_per_reading = 1;
  float range_min_m = 0;
  float range_max_m = 0;
  LayerMask layers = kAllLayers;
  FanField field;

  [[nodiscard]] static FanTable make(const FanQuery& query, LayerMask layers);
  [[nodiscard]] std::uint32_t readings() const noexcept { return rays / rays_per_reading; }
};

/// Working memory of one thread for casting fans; kept between calls to avoid allocation.
struct FanScratch {
  std::vector<const world::ShapePiece*> discs;  ///< Candidates; allocated for all that may occur.
  std::vector<const world::ShapePiece*> polygons;
  std::size_t disc_count = 0;
  std::size_t polygon_count = 0;
  std::vector<std::uint32_t> near;  ///< Indices of pieces.
  std::vector<float> inverse;       ///< Largest 1/range of each ray so far; 0: no hit.
  std::vector<std::uint32_t> body;  ///< The body of that hit.
  std::vector<float> ranges_m;
};

/// Position of a sensor in W, and sine and cosine of its yaw.
struct SensorPlace {
  Vec2 p_WS;
  SinCos turn;
};

/// The place of a sensor mounted at X_RS, whose yaw has the sine and cosine `mounting`, on a robot
/// at p_WR, whose yaw has those of `turn`. For many robots with one sensor: it computes no sine per
/// robot.
[[nodiscard]] inline SensorPlace sensor_place(Vec2 p_WR, const SinCos& turn, Vec2 p_RS,
                                              const SinCos& mounting) noexcept {
  return {p_WR + rotate(turn, p_RS),
          {turn.sin * mounting.cos + turn.cos * mounting.sin,
           turn.cos * mounting.cos - turn.sin * mounting.sin}};
}
/// Like the above, with the same bits.
[[nodiscard]] inline SensorPlace sensor_place(const Pose2& X_WR, const Pose2& X_RS) noexcept {
  return sensor_place(X_WR.position(), sincos(X_WR.yaw), X_RS.position(), sincos(X_RS.yaw));
}

/// Casts one fan from `place` at height `z_m`. `ranges` and `bodies` have one element per reading;
/// a ray without a hit gives +infinity and no body. The body `owner` is ignored. A sensor inside a
/// body reads 0 in all directions (then range_min). Any thread, each with its own scratch.
/// docs/explanation/ranges.md describes the algorithm.
void cast_fan(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
              double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
              std::span<std::uint32_t> bodies);

}  // namespace rave::sim
