// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave {

/// What a body is, as far as sensors care. The values are bits of a LayerMask.
enum class Layer : std::uint32_t {
  kVirtualObstacles = 1,  ///< Exist in the virtual world alone.
  kMappedReal = 2,        ///< Walls and tubes that exist on the floor too.
  kSimulatedRobots = 4,
  kRealRobots = 8,
};

/// The name of a layer, as in robot and world files.
[[nodiscard]] std::string_view to_string(Layer layer) noexcept;

/// A set of layers, one bit each.
using LayerMask = std::uint32_t;
/// The set of all layers.
inline constexpr LayerMask kAllLayers = 15;
/// What the real half of a hybrid sensor cannot see.
inline constexpr LayerMask kUnrealLayers = 1 | 4;

/// Whether a layer is in a set.
[[nodiscard]] constexpr bool contains(LayerMask mask, Layer layer) noexcept {
  return (mask & static_cast<std::uint32_t>(layer)) != 0;
}

}  // namespace rave
