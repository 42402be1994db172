// SPDX-License-Identifier: Apache-2.0
#include "rave/probe/probe_block.hpp"

#include <array>

#include "rave/assemble/devices.hpp"
#include "rave/base/names.hpp"
#include "rave/config/diagnostics.hpp"
#include "rave/config/yaml.hpp"
#include "rave/math/scalar.hpp"

namespace rave::probe {
namespace {

using config::RawNode;

/// Larger than any robot.
constexpr double kFarthest_m = 100;
constexpr double kWholeTurn_deg = 360;

struct NamedLayer {
  std::string_view name;
  Layer layer;
};
constexpr std::array kLayers = {NamedLayer{"virtual_obstacles", Layer::kVirtualObstacles},
                                NamedLayer{"mapped_real", Layer::kMappedReal},
                                NamedLayer{"simulated_robots", Layer::kSimulatedRobots},
                                NamedLayer{"real_robots", Layer::kRealRobots}};

Status check_keys(const RawNode& node, std::span<const std::string_view> known,
                  std::string_view where) {
  if (!node.is_mapping()) {
    return fail(ErrorCode::kParse, "{}: expected a mapping, found {}", where, node.found_text());
  }
  for (const std::string_view key : node.keys()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    return fail(ErrorCode::kParse, "{}: unknown key `{}`; expected {}", where, key,
                join_names(std::vector<std::string_view>(known.begin(), known.end())));
  }
  return {};
}

Result<std::string> text_in(const RawNode& node, std::string_view key) {
  const RawNode* const value = node.find(key);
  const auto text = value == nullptr ? std::nullopt : value->as_text();
  if (text && !text->empty()) return *text;
  return fail(ErrorCode::kParse, "`{}`: expected a name", key);
}

Result<double> number_in(const RawNode& node, std::string_view key, double most) {
  const RawNode* const value = node.find(key);
  if (value == nullptr) return 0;
  const auto number = value->as_double();
  if (number && *number >= -most && *number <= most) return *number;
  return fail(ErrorCode::kParse, "`mount.{}`: expected a number from {} to {}", key, -most, most);
}

Status read_mount(const RawNode& block, sim::SensorSpec& sensor) {
  const RawNode* const mount = block.find("mount");
  if (mount == nullptr) return {};
  static constexpr std::array<std::string_view, 4> kKeys = {"x_m", "y_m", "z_m", "yaw_deg"};
  RAVE_TRY(check_keys(*mount, kKeys, "`mount`"));
  RAVE_TRY_ASSIGN(const double x_m, number_in(*mount, "x_m", kFarthest_m));
  RAVE_TRY_ASSIGN(const double y_m, number_in(*mount, "y_m", kFarthest_m));
  RAVE_TRY_ASSIGN(sensor.z_m, number_in(*mount, "z_m", kFarthest_m));
  RAVE_TRY_ASSIGN(const double yaw_deg, number_in(*mount, "yaw_deg", kWholeTurn_deg));
  sensor.X_RS = {x_m, y_m, wrap_angle(deg_to_rad(yaw_deg))};
  return {};
}

Status read_layers(const RawNode& block, sim::SensorSpec& sensor) {
  const RawNode* const senses = block.find("senses");
  if (senses == nullptr) return {};
  LayerMask mask = 0;
  for (const RawNode& item : senses->children()) {
    const auto* const found =
        std::find_if(kLayers.begin(), kLayers.end(),
                     [&item](const NamedLayer& layer) { return layer.name == item.scalar(); });
    if (found == kLayers.end()) {
      return fail(ErrorCode::kParse,
                  "`senses`: expected virtual_obstacles, mapped_real, simulated_robots or "
                  "real_robots");
    }
    mask |= static_cast<LayerMask>(found->layer);
  }
  if (mask == 0) return fail(ErrorCode::kParse, "`senses`: expected a list of layers");
  sensor.layers = mask;
  return {};
}

Status read_driver(const RawNode& block, plugin::Catalogue& catalogue, sim::SensorSpec& sensor) {
  RAVE_TRY_ASSIGN(const std::string name, text_in(block, "driver"));
  constexpr std::array kKinds = {DriverKind::kVirtualSensor};
  RAVE_TRY_ASSIGN(const plugin::Driver* const driver, catalogue.find(kKinds, name));
  sensor.driver = driver->info.name;
  sensor.kind = static_cast<ReadingKind>(driver->info.data_kind);
  sensor.virtual_ops = static_cast<const VirtualSensorOps*>(driver->ops);
  const RawNode* const params = block.find("params");
  RAVE_TRY_ASSIGN(sensor.params,
                  runtime::read_params(*driver, params == nullptr ? RawNode() : *params));
  return {};
}

}  // namespace

Result<sim::SensorSpec> read_block(std::string_view block, plugin::Catalogue& catalogue) {
  if (block.size() > kLongestBlock) {
    return fail(ErrorCode::kParse, "the sensor has {} bytes, more than {}", block.size(),
                kLongestBlock);
  }
  config::Diagnostics diagnostics;
  const auto node = config::parse_yaml(block, "sensor", diagnostics);
  if (!node || !diagnostics.ok()) {
    return fail(ErrorCode::kParse, "the sensor is not valid YAML; expected an entry of `sensors:`");
  }
  static constexpr std::array<std::string_view, 5> kKeys = {"name", "driver", "mount", "senses",
                                                            "params"};
  RAVE_TRY(check_keys(*node, kKeys, "the sensor"));
  sim::SensorSpec sensor;
  RAVE_TRY_ASSIGN(sensor.name, text_in(*node, "name"));
  RAVE_TRY(read_mount(*node, sensor));
  RAVE_TRY(read_layers(*node, sensor));
  RAVE_TRY(read_driver(*node, catalogue, sensor));
  return sensor;
}

}  // namespace rave::probe
