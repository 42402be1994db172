// SPDX-License-Identifier: Apache-2.0
#include "rave/probe/probe_block.hpp"

#include <array>
#include <vector>

#include "rave/assemble/devices.hpp"
#include "rave/config/fields.hpp"
#include "rave/math/scalar.hpp"

namespace rave {

constexpr auto enum_names(codec::EnumTag<Layer> /*tag*/) {
  return std::array{codec::EnumName{Layer::kVirtualObstacles, "virtual_obstacles"},
                    codec::EnumName{Layer::kMappedReal, "mapped_real"},
                    codec::EnumName{Layer::kSimulatedRobots, "simulated_robots"},
                    codec::EnumName{Layer::kRealRobots, "real_robots"}};
}

namespace probe {
namespace {

/// The part of config::MountFile that a probe has.
struct ProbeMount {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
  double yaw_deg = 0;
};

/// The part of config::SensorFile that a probe has.
struct ProbeFile {
  std::string name;
  std::string driver;
  ProbeMount mount;
  std::optional<std::vector<Layer>> senses;
  codec::RawNode params;
};

template <class V>
void describe(V& v, ProbeMount& c) {
  // Larger than any robot.
  constexpr codec::FieldOptions kLength{.min = -100, .max = 100, .unit = "m"};
  v.field("x_m", c.x_m, kLength);
  v.field("y_m", c.y_m, kLength);
  v.field("z_m", c.z_m, kLength);
  v.field("yaw_deg", c.yaw_deg, {.min = -360, .max = 360, .unit = "deg"});
}

template <class V>
void describe(V& v, ProbeFile& c) {
  v.required("name", c.name, {.min_items = 1});
  v.required("driver", c.driver, {.min_items = 1});
  v.field("mount", c.mount);
  v.field("senses", c.senses, {.min_items = 1});
  v.field("params", c.params);
}

Status take_driver(const ProbeFile& file, plugin::Catalogue& catalogue, sim::SensorSpec& sensor) {
  constexpr std::array kKinds = {DriverKind::kVirtualSensor};
  RAVE_TRY_ASSIGN(const plugin::Driver* const driver, catalogue.find(kKinds, file.driver));
  sensor.driver = driver->info.name;
  sensor.kind = static_cast<ReadingKind>(driver->info.data_kind);
  sensor.virtual_ops = static_cast<const VirtualSensorOps*>(driver->ops);
  RAVE_TRY_ASSIGN(sensor.params, runtime::read_params(*driver, file.params));
  return {};
}

}  // namespace

Result<sim::SensorSpec> read_block(std::string_view block, plugin::Catalogue& catalogue) {
  if (block.size() > kLongestBlock) {
    return fail(ErrorCode::kParse, "the sensor has {} bytes, more than {}", block.size(),
                kLongestBlock);
  }
  RAVE_TRY_ASSIGN(ProbeFile file, config::read_text<ProbeFile>(block, "sensor"));
  sim::SensorSpec sensor;
  sensor.name = std::move(file.name);
  sensor.z_m = file.mount.z_m;
  sensor.X_RS = {file.mount.x_m, file.mount.y_m, wrap_angle(deg_to_rad(file.mount.yaw_deg))};
  if (file.senses) {
    sensor.layers = 0;
    for (const Layer layer : *file.senses) sensor.layers |= static_cast<LayerMask>(layer);
  }
  RAVE_TRY(take_driver(file, catalogue, sensor));
  return sensor;
}

}  // namespace probe
}  // namespace rave
