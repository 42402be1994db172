// SPDX-License-Identifier: Apache-2.0
#include "hybrid_device.hpp"

#include <array>

#include "device_tools.hpp"
#include "shared_device.hpp"

namespace rave::runtime {
namespace {

using plugin::Driver;

/// The layers that the real half cannot sense.
constexpr LayerMask kUnseenByReal = static_cast<LayerMask>(Layer::kVirtualObstacles) |
                                    static_cast<LayerMask>(Layer::kSimulatedRobots);

ReadingKind kind_of(const Driver& driver) {
  return static_cast<ReadingKind>(driver.info.data_kind);
}

Result<const Driver*> find_half(const DeviceContext& context, const config::SensorFile& file,
                                const config::SensorHalfFile& half, DriverKind kind,
                                const Driver& fusing) {
  const std::array kinds = {kind};
  RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kinds, half.driver));
  if (kind_of(*driver) == kind_of(fusing)) return driver;
  // Both halves must give what the fusing driver takes, because it combines them reading by
  // reading.
  return fail_at(half.driver.where, ErrorCode::kInvalidArgument,
                 "sensor `{}`: the driver `{}` fuses {}, but its {} half (driver `{}`) gives {}",
                 file.name.value, fusing.info.name, to_string(kind_of(fusing)),
                 kind == DriverKind::kSensor ? "real" : "virtual", driver->info.name,
                 to_string(kind_of(*driver)));
}

}  // namespace

Status set_hybrid(const DeviceContext& context, const config::RobotGroup& group,
                  const config::SensorFile& file, const sim::RobotType& type,
                  sim::SensorSpec& sensor) {
  constexpr std::array kKinds = {DriverKind::kHybridSensor};
  RAVE_TRY_ASSIGN(const Driver* const fusing, find_driver(context, kKinds, file.driver));
  RAVE_TRY_ASSIGN(const Driver* const real,
                  find_half(context, file, *file.real, DriverKind::kSensor, *fusing));
  RAVE_TRY_ASSIGN(const Driver* const imagined,
                  find_half(context, file, *file.imagined, DriverKind::kVirtualSensor, *fusing));
  sensor.driver = fusing->info.name;
  sensor.where = file.driver.where;
  sensor.kind = kind_of(*fusing);
  // A hybrid has the timing and the device of its real half: the hardware says when there is a
  // sample, and the virtual half is asked for the same stamp.
  sensor.hardware_ops = static_cast<const HardwareSensorOps*>(real->ops);
  sensor.timing = real->info.timing;
  RAVE_TRY_ASSIGN(sensor.device,
                  shared_device(context, *real, file.real->driver, file.real->device, type));
  RAVE_TRY_ASSIGN(sensor.params, read_sensor_params(context, *real, file.real->params));
  sim::HybridSpec hybrid;
  hybrid.ops = static_cast<const HybridSensorOps*>(fusing->ops);
  RAVE_TRY_ASSIGN(hybrid.params, read_params(*fusing, file.params));
  hybrid.real_driver = real->info.name;
  hybrid.real_noise = noise_of(file.real->noise);
  hybrid.virtual_driver = imagined->info.name;
  hybrid.virtual_ops = static_cast<const VirtualSensorOps*>(imagined->ops);
  RAVE_TRY_ASSIGN(hybrid.virtual_params, read_params(*imagined, file.imagined->params));
  hybrid.virtual_noise = noise_of(file.imagined->noise);
  // By default the virtual half adds only what is invisible to the real one. Otherwise a wall that
  // both sense would be counted twice.
  sensor.layers = file.imagined->senses ? layer_mask(file.imagined->senses->value) : kUnseenByReal;
  sensor.hybrid = std::move(hybrid);
  note_clock(context, group, sensor.name, real->info, sensor.params);
  return {};
}

}  // namespace rave::runtime
