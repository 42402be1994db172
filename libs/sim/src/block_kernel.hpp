// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "fan_kernel.hpp"

namespace rave::sim {

/// Pieces that the sensors of a block have before them, those of each sensor in their order.
struct SeenBy {
  Pieces pieces;
  const std::uint16_t* askers = nullptr;  ///< The sensor that has each of them before it.
};

/// The sensors of a block, which all have the same fan, of at most kFewRays.
struct BlockView {
  const float* cos = nullptr;  ///< As FanView has them.
  const float* sin = nullptr;
  std::size_t padded = 0;
  const FanPlace* places = nullptr;
  std::size_t askers = 0;
  float* inverse = nullptr;       ///< Out: `padded` numbers for each sensor, as FanView has them.
  std::uint32_t* body = nullptr;  ///< Out: the same.
};

/// cast_pieces() for all sensors of a block, with the same bits.
void cast_block(const SeenBy& discs, const SeenBy& polygons, const Vec2* vertices_W,
                const Vec2* normals_W, const BlockView& view);

}  // namespace rave::sim
