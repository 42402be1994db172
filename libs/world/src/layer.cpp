// SPDX-License-Identifier: Apache-2.0
#include "rave/world/layer.hpp"

namespace rave {

std::string_view to_string(Layer layer) noexcept {
  switch (layer) {
    case Layer::kVirtualObstacles:
      return "virtual_obstacles";
    case Layer::kMappedReal:
      return "mapped_real";
    case Layer::kSimulatedRobots:
      return "simulated_robots";
    case Layer::kRealRobots:
      return "real_robots";
  }
  return "unknown";
}

}  // namespace rave
