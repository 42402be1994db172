// SPDX-License-Identifier: Apache-2.0
#include "seen_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rave::replay {
namespace {

using config::ObstacleLayer;
using config::SensedLayer;

bool senses_virtual(const std::optional<codec::Located<std::vector<SensedLayer>>>& senses) {
  return !senses ||
         std::ranges::find(senses->value, SensedLayer::kVirtualObstacles) != senses->value.end();
}

}  // namespace

void SeenObstacles::note(const std::string& robot, const config::SensorFile& sensor,
                         bool is_virtual) {
  // A hybrid senses them with its virtual half; a driver of hardware never does.
  const bool saw = sensor.imagined ? senses_virtual(sensor.imagined->senses)
                                   : is_virtual && senses_virtual(sensor.senses);
  std::string& first = saw ? saw_ : missed_;
  if (first.empty()) first = fmt::format("{}/{}", robot, sensor.name.value);
}

std::string SeenObstacles::put_on_layer(config::WorldFile& world) {
  const auto is_virtual = [](const auto& body) {
    return body.layer == ObstacleLayer::kVirtualObstacles;
  };
  const bool any = std::ranges::any_of(world.obstacles, is_virtual) ||
                   std::ranges::any_of(world.maps, is_virtual);
  if (!any || saw_.empty()) return {};
  if (!all_saw()) {
    return fmt::format(
        "`{}` had sensed the virtual obstacles and `{}` had not, so they keep the layer "
        "`virtual_obstacles`; a hybrid sensor with the readings of `{}` senses them twice",
        saw_, missed_, saw_);
  }
  for (config::ObstacleFile& obstacle : world.obstacles)
    obstacle.layer = ObstacleLayer::kMappedReal;
  for (config::MapFile& map : world.maps) map.layer = ObstacleLayer::kMappedReal;
  return "obstacles have the layer `mapped_real`, because the played range sensors had sensed them";
}

void SeenObstacles::put_on_layer(codec::RawNode& changes) const {
  if (!all_saw()) return;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    codec::RawNode& change = changes.child(i);
    const codec::RawNode* const added = change.find("add_obstacle");
    if (added == nullptr || !added->is_mapping()) continue;
    codec::RawNode obstacle = *added;
    obstacle.set("layer", codec::RawNode::text("mapped_real"));
    change.set("add_obstacle", std::move(obstacle));
  }
}

}  // namespace rave::replay
