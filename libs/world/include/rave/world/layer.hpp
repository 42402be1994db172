// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave {

/// The class of a body for sensors. The values are bits of a LayerMask.
enum class Layer : std::uint32_t {
  kVirtualObstacles = 1,  ///< Exists in the virtual world only.
  kMappedReal = 2,        ///< Walls and tubes that also exist on the real floor.
  kSimulatedRobots = 4,
  kRealRobots = 8,
};

/// The name of a layer in robot and world files.
[[nodiscard]] std::string_view to_string(Layer layer) noexcept;

/// A set of layers, one bit each.
using LayerMask = std::uint32_t;
/// The set of all layers.
inline constexpr LayerMask kAllLayers = 15;
/// The layers that the real half of a hybrid sensor cannot sense.
inline constexpr LayerMask kUnrealLayers = 1 | 4;

/// Whether the set contains the layer.
[[nodiscard]] constexpr bool contains(LayerMask mask, Layer layer) noexcept {
  return (mask & static_cast<std::uint32_t>(layer)) != 0;
}

}  // namespace rave
