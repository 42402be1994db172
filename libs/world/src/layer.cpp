// SPDX-License-Identifier: Apache-2.0
#include "rave/world/layer.hpp"

#include "rave/base/word_table.hpp"

namespace rave {
namespace {

constexpr WordTable<Layer, 4> kLayers = {{
    {"virtual_obstacles", Layer::kVirtualObstacles},
    {"mapped_real", Layer::kMappedReal},
    {"simulated_robots", Layer::kSimulatedRobots},
    {"real_robots", Layer::kRealRobots},
}};

}  // namespace

std::string_view to_string(Layer layer) noexcept { return kLayers.of(layer, "unknown"); }

}  // namespace rave
