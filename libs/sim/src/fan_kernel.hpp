// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/world/shape_grid.hpp"

namespace rave::sim {

/// Rays are handled in groups; tables and results are padded to a multiple of the largest.
inline constexpr std::size_t kRayPadding = 16;
[[nodiscard]] inline std::size_t padded(std::size_t count) noexcept {
  return (count + kRayPadding - 1) / kRayPadding * kRayPadding;
}
/// Buckets of FanView::first_ray.
inline constexpr std::size_t kBearingBuckets = 512;
/// Up to this number of rays, all of them are tried against every candidate; above, an index finds
/// those between the edges of the candidate.
inline constexpr std::size_t kFewRays = 32;

/// The rays of a fan, and where what they met is kept.
struct FanView {
  const float* cos = nullptr;  ///< Directions in the sensor frame; 0 in the padding.
  const float* sin = nullptr;
  std::size_t padded = 0;  ///< A multiple of kRayPadding.
  /// For each bucket of the bearing the first ray that does not lie before it; kBearingBuckets + 1
  /// of them. Null: all rays are tried.
  const std::uint16_t* first_ray = nullptr;
  float* inverse = nullptr;       ///< Out: largest 1/range; 0: nothing.
  std::uint32_t* body = nullptr;  ///< Out: what it belongs to.
};

/// What a sensor says of a range.
struct RangeLimits {
  float min_m = 0;  ///< Nearer reads this.
  float max_m = 0;  ///< Farther is no return: +infinity, no body.
};

/// Where a sensor stands.
struct FanPlace {
  double x_m = 0;
  double y_m = 0;
  float cos = 1;
  float sin = 0;
};

using Pieces = std::span<const world::ShapePiece* const>;

/// Puts what the rays meet of the pieces' shapes into `fan.inverse` and `fan.body`; what was there
/// before is lost. Picks the widest instructions that the processor has; the bits are the same with
/// all of them.
void cast_pieces(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                 const FanPlace& place, const FanView& fan);

/// 1/inverse for each ray, within the limits, and whose it is: `ranges` and `bodies` are padded as
/// the fan is. `bodies` may be those of the fan.
void finish_ranges(const FanView& fan, RangeLimits limits, float* ranges_m, std::uint32_t* bodies);

/// The bearing as a number that grows with it from 0 at -pi to 4 at pi, without arc tangent.
inline float bearing_scale(float x, float y) noexcept {
  const float sum = (x < 0 ? -x : x) + (y < 0 ? -y : y);
  // Grows along each edge of the square |x| + |y| = const, which is passed in the order of
  // bearings.
  const float part = sum > 0 ? x / sum : 1.0F;
  return y < 0 ? 1 + part : 3 - part;
}

/// The bucket of a bearing.
inline std::size_t bearing_bucket(float scale) noexcept {
  const auto bucket =
      static_cast<std::size_t>(scale * (static_cast<float>(kBearingBuckets) / 4.0F));
  return bucket < kBearingBuckets ? bucket : kBearingBuckets - 1;
}

}  // namespace rave::sim
