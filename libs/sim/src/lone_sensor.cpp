// SPDX-License-Identifier: Apache-2.0
// A virtual sensor without an engine, for a person who tries one beside the run. Nothing of it
// reaches the run or its hash.
#include "rave/sim/lone_sensor.hpp"

#include <algorithm>
#include <vector>

#include "declared_fan.hpp"
#include "instances.hpp"
#include "plugin_call.hpp"
#include "rave/sim/random_devices.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

struct LoneSensor::Parts {
  SensorSpec spec;
  InstanceArray instance;
  SensorInfo info;
  bool uses_fan = false;
  FanTable fan;
  FanScratch scratch;
  std::vector<std::byte> records;
  std::vector<std::uint32_t> bodies;
  std::vector<std::byte> state;
  SampleHeader header{};
  bool failed = false;
};

LoneSensor::LoneSensor(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LoneSensor::~LoneSensor() = default;

const SensorSpec& LoneSensor::spec() const noexcept { return parts_->spec; }
const SensorInfo& LoneSensor::info() const noexcept { return parts_->info; }
const SampleHeader& LoneSensor::header() const noexcept { return parts_->header; }
const void* LoneSensor::records() const noexcept { return parts_->records.data(); }

Result<std::unique_ptr<LoneSensor>> LoneSensor::make(SensorSpec spec, double step_s) {
  if (spec.virtual_ops == nullptr) {
    return fail(ErrorCode::kInvalidArgument,
                "the driver `{}` is not virtual; expected a virtual sensor", spec.driver);
  }
  auto parts = std::make_unique<Parts>();
  parts->spec = std::move(spec);
  const SensorSpec& its = parts->spec;
  RAVE_TRY(parts->instance.make(its.virtual_ops->instance, 1));
  auto setup = setup_with<VirtualSensorSetup>(its.params);
  setup.layers = its.layers;
  setup.period_s = its.period_steps * step_s;
  setup.z_m = its.z_m;
  SensorInfo& info = parts->info;
  info.name = its.name.c_str();
  info.kind = its.kind;
  info.X_RS = its.X_RS;
  info.z_m = its.z_m;
  info.period_s = setup.period_s;
  RAVE_TRY_ASSIGN(const VirtualDeclaration declaration,
                  declaration_of(*its.virtual_ops, parts->instance.at(0), setup, its.kind, info));
  parts->uses_fan = declaration.uses_fan != 0;
  // A person may try any parameters; what would take seconds per sample is refused.
  if (info.capacity > kMostRecords || (parts->uses_fan && declaration.fan.ray_count > kMostRays)) {
    return fail(ErrorCode::kInvalidArgument,
                "the sensor has {} readings of {} rays; expected at most {} of {}", info.capacity,
                declaration.fan.ray_count, kMostRecords, kMostRays);
  }
  if (parts->uses_fan) {
    parts->fan = FanTable::make(declaration.fan, its.layers);
    parts->bodies.resize(info.capacity);
  }
  parts->records.resize(info.capacity * record_size(its.kind));
  parts->state.resize(its.virtual_ops->state_size);
  return std::unique_ptr<LoneSensor>(new LoneSensor(std::move(parts)));
}

Status LoneSensor::sample(const world::Snapshot& world, RobotId robot, std::uint64_t seed) {
  Parts& its = *parts_;
  if (its.failed || !world.robot(robot).present) return {};
  // The time since its last sample, whatever that was: the page asks when it wants to.
  const double elapsed_s =
      its.header.sequence == 0 ? 0 : SimTime{world.time().ns - its.header.stamp_ns}.seconds();
  const std::uint32_t sequence = its.header.sequence;
  its.header = {world.time().ns, sequence + 1, 0, 1, 0};
  const Pose2 X_WR = world.pose(robot);
  if (its.uses_fan) {
    cast_fan(world, its.fan, sensor_place(X_WR, its.info.X_RS), its.info.z_m, world.body_of(robot),
             its.scratch, {reinterpret_cast<float*>(its.records.data()), its.info.capacity},
             its.bodies);
    its.header.count = its.info.capacity;
    return {};
  }
  SampleItem item;
  item.robot = robot;
  item.device = kLoneDevice;
  item.seed = seed;
  item.sequence = sequence;
  item.capacity = its.info.capacity;
  item.X_WR = X_WR;
  item.X_WS = compose(X_WR, its.info.X_RS);
  item.z_m = its.info.z_m;
  item.elapsed_s = elapsed_s;
  item.header = &its.header;
  item.records = its.records.data();
  item.state = its.state.data();
  const Status sampled = sample_one(*its.spec.virtual_ops, its.instance.at(0), world, item);
  if (sampled) return {};
  its.failed = true;
  its.header.count = 0;
  return fail(ErrorCode::kPlugin, "the driver `{}`: {}", its.spec.driver, sampled.error().message);
}

}  // namespace rave::sim
