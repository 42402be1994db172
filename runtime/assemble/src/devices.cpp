// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/devices.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "device_tools.hpp"
#include "hybrid_device.hpp"
#include "rave/base/names.hpp"
#include "rave/math/scalar.hpp"
#include "shared_device.hpp"

namespace rave::runtime {
namespace {

using plugin::Driver;

}  // namespace

Result<const Driver*> find_driver(const DeviceContext& context, std::span<const DriverKind> kinds,
                                  const codec::Located<std::string>& name) {
  auto driver = context.catalogue.find(kinds, name.value);
  if (driver) return driver;
  Error error = std::move(driver).error();
  // The catalogue does not know which file names the driver.
  if (error.where.file.empty()) error.where = name.where;
  return tl::unexpected(std::move(error));
}

LayerMask layer_mask(const std::vector<config::SensedLayer>& layers) {
  using config::SensedLayer;
  constexpr std::pair<SensedLayer, Layer> kLayers[] = {
      {SensedLayer::kVirtualObstacles, Layer::kVirtualObstacles},
      {SensedLayer::kMappedReal, Layer::kMappedReal},
      {SensedLayer::kSimulatedRobots, Layer::kSimulatedRobots},
      {SensedLayer::kRealRobots, Layer::kRealRobots}};
  LayerMask mask = 0;
  for (const auto& [sensed, layer] : kLayers) {
    if (std::ranges::find(layers, sensed) != layers.end()) mask |= static_cast<LayerMask>(layer);
  }
  return mask;
}

NoiseSpec noise_of(const config::NoiseFile& noise) {
  return {noise.length_sigma_m,     deg_to_rad(noise.angle_sigma_deg),   noise.velocity_sigma_mps,
          noise.length_quantum_m,   deg_to_rad(noise.angle_quantum_deg), noise.velocity_quantum_mps,
          noise.dropout_probability};
}

void note_clock(const DeviceContext& context, const config::RobotGroup& group,
                const std::string& device, const DriverInfo& info, const plugin::ParamSet& params) {
  bool live = info.clock == DriverClock::kLive;
  // Such drivers, for example players of logs, have the parameter `clock` with the choice `live`.
  if (info.clock == DriverClock::kEither) {
    live = Params(params.values()).text("clock") == "live";
  }
  // One live driver makes the whole run live. The first one is named, because a user who expected a
  // run hash asks which driver prevents it.
  if (live && context.built.live_reason.empty()) {
    context.built.live_reason =
        fmt::format("`{}` of robot `{}` uses the driver `{}`, which follows the wall clock", device,
                    group.name.value, info.name);
  }
}

std::uint32_t in_steps(const DeviceContext& context,
                       const std::optional<codec::Located<double>>& time_s) {
  if (!time_s) return 1;
  // The expansion has checked that the time is a multiple of the step; lround() removes the error
  // of the division, for example of 0.3 / 0.1.
  return static_cast<std::uint32_t>(
      std::lround(time_s->value / context.scenario.scenario.step_s.value));
}

namespace {

ProcessingSpec processing_of(const config::SensorFile& sensor) {
  ProcessingSpec spec;
  spec.noise = noise_of(sensor.noise);
  spec.latency_s = sensor.latency_s;
  for (const config::FilterFile& filter : sensor.filters) {
    FilterSpec stage;
    if (filter.median) {
      stage.kind = FilterSpec::Kind::kMedian;
      stage.window = filter.median->window;
    } else {
      stage.kind = FilterSpec::Kind::kExponential;
      stage.time_constant_s = filter.exponential->time_constant_s;
    }
    spec.filters.push_back(stage);
  }
  return spec;
}

Status add_shared(const DeviceContext& context, const config::RobotGroup& group,
                  sim::RobotType& type) {
  for (const config::DeviceFile& file : group.robot.devices) {
    sim::DeviceSpec device;
    RAVE_TRY_ASSIGN(const Driver* const driver,
                    begin_device(context, DriverKind::kDevice, file, device));
    RAVE_TRY_ASSIGN(device.params, read_params(*driver, file.params));
    note_clock(context, group, device.name, driver->info, device.params);
    type.devices.push_back(std::move(device));
  }
  return {};
}

Status set_plain(const DeviceContext& context, const config::RobotGroup& group,
                 const config::SensorFile& file, const sim::RobotType& type,
                 sim::SensorSpec& sensor) {
  constexpr std::array kKinds = {DriverKind::kSensor, DriverKind::kVirtualSensor,
                                 DriverKind::kHybridSensor};
  RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
  sensor.driver = driver->info.name;
  sensor.where = file.driver.where;
  if (driver->info.kind == DriverKind::kHybridSensor) {
    return fail_at(file.driver.where, ErrorCode::kInvalidArgument,
                   "the driver `{}` of sensor `{}` fuses two halves: expected `real:` and "
                   "`virtual:`, each with a `driver`",
                   driver->info.name, sensor.name);
  }
  sensor.kind = static_cast<ReadingKind>(driver->info.data_kind);
  // The kind of the driver says whether the sensor is real. The robot file does not, so a change of
  // the driver alone turns a simulated robot into a real one.
  if (driver->info.kind == DriverKind::kVirtualSensor) {
    sensor.virtual_ops = static_cast<const VirtualSensorOps*>(driver->ops);
    if (file.max_age_s) {
      return fail_at(file.max_age_s->where, ErrorCode::kInvalidArgument,
                     "`max_age_s` is for real sensors; the driver `{}` of sensor `{}` is virtual",
                     driver->info.name, sensor.name);
    }
  } else {
    sensor.hardware_ops = static_cast<const HardwareSensorOps*>(driver->ops);
    sensor.timing = driver->info.timing;
    if (file.senses) {
      return fail_at(file.senses->where, ErrorCode::kInvalidArgument,
                     "`senses` is for virtual sensors; the driver `{}` of sensor `{}` is real",
                     driver->info.name, sensor.name);
    }
  }
  RAVE_TRY_ASSIGN(sensor.device, shared_device(context, *driver, file.driver, file.device, type));
  RAVE_TRY_ASSIGN(sensor.params, read_sensor_params(context, *driver, file.params));
  note_clock(context, group, sensor.name, driver->info, sensor.params);
  if (file.senses) sensor.layers = layer_mask(file.senses->value);
  return {};
}

Result<sim::SensorSpec> make_sensor(const DeviceContext& context, const config::RobotGroup& group,
                                    const config::SensorFile& file, const sim::RobotType& type) {
  sim::SensorSpec sensor;
  sensor.name = file.name.value;
  RAVE_TRY(file.real ? set_hybrid(context, group, file, type, sensor)
                     : set_plain(context, group, file, type, sensor));
  const config::MountFile& mount = file.mount.value;
  sensor.X_RS = {mount.x_m, mount.y_m, wrap_angle(deg_to_rad(mount.yaw_deg))};
  sensor.z_m = mount.z_m;
  set_rhythm(context, file, sensor);
  sensor.processing = processing_of(file);
  if (file.max_age_s) sensor.max_age_s = file.max_age_s->value;
  return sensor;
}

Status add_actuators(const DeviceContext& context, const config::RobotGroup& group,
                     sim::RobotType& type) {
  constexpr std::array kKinds = {DriverKind::kActuator, DriverKind::kVirtualActuator};
  // A virtual actuator moves the body and two of them would fight over it. Hardware may have
  // several actuators, each with a part of its own, but not beside a virtual one: the body can only
  // be where the world says or where the pose source says.
  const config::ActuatorFile* hardware = nullptr;
  const config::ActuatorFile* simulated = nullptr;
  for (const config::ActuatorFile& file : group.robot.actuators) {
    RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
    sim::ActuatorSpec actuator;
    actuator.name = file.name.value;
    actuator.driver = driver->info.name;
    actuator.where = file.driver.where;
    if (driver->info.kind == DriverKind::kVirtualActuator) {
      if (simulated != nullptr) {
        return fail_at(file.name.where, ErrorCode::kInvalidArgument,
                       "actuators `{}` and `{}` both move the body; expected one that does",
                       simulated->name.value, actuator.name);
      }
      simulated = &file;
      actuator.virtual_ops = static_cast<const VirtualActuatorOps*>(driver->ops);
    } else {
      hardware = &file;
      actuator.hardware_ops = static_cast<const HardwareActuatorOps*>(driver->ops);
    }
    RAVE_TRY_ASSIGN(actuator.device,
                    shared_device(context, *driver, file.driver, file.device, type));
    RAVE_TRY_ASSIGN(actuator.params, read_params(*driver, file.params));
    actuator.param_specs = driver->info.param_specs();
    note_clock(context, group, actuator.name, driver->info, actuator.params);
    type.actuators.push_back(std::move(actuator));
  }
  if (hardware != nullptr && simulated != nullptr) {
    return fail_at(simulated->driver.where, ErrorCode::kInvalidArgument,
                   "actuator `{}` is simulated and `{}` is real; expected all of one kind",
                   simulated->name.value, hardware->name.value);
  }
  return {};
}

Status add_controllers(const DeviceContext& context, const config::RobotGroup& group,
                       sim::RobotType& type) {
  for (const config::ControllerFile& file : group.robot.controllers) {
    sim::ControllerSpec controller;
    RAVE_TRY_ASSIGN(const Driver* const driver,
                    begin_device(context, DriverKind::kController, file, controller));
    controller.accepts = static_cast<CommandKind>(driver->info.data_kind);
    for (std::uint32_t a = 0; a < type.actuators.size(); ++a) {
      if (type.actuators[a].name == file.actuator.value) controller.actuator = a;
    }
    // The reader of the file has checked that the name exists.
    const sim::ActuatorSpec& actuator = type.actuators[controller.actuator];
    const auto actuator_kinds = std::array{DriverKind::kActuator, DriverKind::kVirtualActuator};
    RAVE_TRY_ASSIGN(const Driver* const served,
                    context.catalogue.find(actuator_kinds, actuator.driver));
    // The kinds must agree here. A mismatch would otherwise show only during the run, as commands
    // that the actuator does not understand.
    const auto wanted = static_cast<CommandKind>(served->info.data_kind);
    // A drive knows which of its commands lead to a velocity.
    const DriveOps& drive = actuator.virtual_ops != nullptr ? actuator.virtual_ops->drive
                                                            : actuator.hardware_ops->drive;
    const bool of_velocity =
        drive.command != nullptr && controller.ops->gives == CommandKind::kVelocity;
    if (controller.ops->gives != wanted && !of_velocity) {
      return fail_at(file.driver.where, ErrorCode::kInvalidArgument,
                     "controller `{}` gives {} commands, but actuator `{}` (driver `{}`) takes {}",
                     controller.name, to_string(controller.ops->gives), actuator.name,
                     actuator.driver, to_string(wanted));
    }
    RAVE_TRY_ASSIGN(controller.params, read_params(*driver, file.params));
    controller.param_specs = driver->info.param_specs();
    type.controllers.push_back(std::move(controller));
  }
  return {};
}

/// A robot that drives by ranges must know their age limit, which the driver or the file must give.
Status check_ages(const DeviceContext& context, const config::RobotGroup& group,
                  const sim::RobotType& type) {
  constexpr std::array kKinds = {DriverKind::kSensor};
  const bool drives = std::any_of(type.actuators.begin(), type.actuators.end(),
                                  [](const auto& a) { return a.hardware_ops != nullptr; });
  if (type.simulated || !drives) return {};
  for (std::size_t s = 0; s < type.sensors.size(); ++s) {
    const sim::SensorSpec& sensor = type.sensors[s];
    const config::SensorFile& file = group.robot.sensors[s];
    if (sensor.hardware_ops == nullptr || sensor.kind != ReadingKind::kRanges) continue;
    // For other timings the engine derives the limit itself, for example from the period that the
    // driver declares.
    if (sensor.timing != SampleTiming::kUnknown || sensor.max_age_s) continue;
    RAVE_TRY_ASSIGN(const Driver* const driver,
                    context.catalogue.find(kKinds, sensor.hardware_driver()));
    // A recording cannot fall silent, and a recorded robot does not drive.
    if (driver->info.clock != DriverClock::kLive) continue;
    return fail_at(file.name.where, ErrorCode::kInvalidArgument,
                   "robot `{}` is real, and the driver `{}` of its range sensor `{}` does not know "
                   "its period: expected `max_age_s`, the age of the newest sample in "
                   "seconds after which the robot is stopped, such as three periods of the sensor "
                   "(`max_age_s: 0.3` at 10 Hz)",
                   group.name.value, driver->info.name, sensor.name);
  }
  return {};
}

Status set_pose_source(const config::RobotGroup& group, sim::RobotType& type) {
  if (!group.robot.pose_from) {
    if (type.simulated) return {};
    return fail_at(group.robot.body.where, ErrorCode::kInvalidArgument,
                   "robot `{}` is real, so others can sense it only if its pose is known: expected "
                   "`pose_from:` with the name of a sensor that gives a pose or odometry",
                   group.name.value);
  }
  const codec::Located<std::string>& name = *group.robot.pose_from;
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    if (type.sensors[s].name != name.value) continue;
    const ReadingKind kind = type.sensors[s].kind;
    if (kind != ReadingKind::kPose && kind != ReadingKind::kOdometry) {
      return fail_at(name.where, ErrorCode::kInvalidArgument,
                     "`pose_from` needs a sensor that gives a pose or odometry, but `{}` gives {}",
                     name.value, to_string(kind));
    }
    if (!type.simulated && type.sensors[s].hybrid) {
      return fail_at(name.where, ErrorCode::kInvalidArgument,
                     "robot `{}` is real, so `pose_from` needs a real sensor, but `{}` (driver "
                     "`{}`) is a hybrid, whose virtual half depends on the pose of the robot; "
                     "add the real half as a separate sensor and name that",
                     group.name.value, name.value, type.sensors[s].driver);
    }
    if (!type.simulated && type.sensors[s].virtual_ops != nullptr) {
      return fail_at(name.where, ErrorCode::kInvalidArgument,
                     "robot `{}` is real, so `pose_from` needs a real sensor, but `{}` (driver "
                     "`{}`) is virtual",
                     group.name.value, name.value, type.sensors[s].driver);
    }
    type.pose_from = s;
  }
  const config::PoseFile& frame = group.robot.source_frame;
  // Pose of the frame of the pose source (M: map or measurement) in the world; identity costs no
  // transform per sample.
  if (frame != config::PoseFile{}) {
    type.X_WM = Pose2{frame.x_m, frame.y_m, wrap_angle(deg_to_rad(frame.yaw_deg))};
  }
  return {};
}

}  // namespace

Status add_devices(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type) {
  // The order matters: sensors and actuators name devices, controllers name actuators, and
  // communicators name transmitters.
  RAVE_TRY(add_shared(context, group, type));
  for (const config::SensorFile& file : group.robot.sensors) {
    RAVE_TRY_ASSIGN(auto sensor, make_sensor(context, group, file, type));
    type.sensors.push_back(std::move(sensor));
  }
  RAVE_TRY(add_actuators(context, group, type));
  RAVE_TRY(add_controllers(context, group, type));
  RAVE_TRY(add_radio(context, group, type));
  RAVE_TRY(add_program(context, group, type));
  bool real = false;
  for (const sim::SensorSpec& sensor : type.sensors) real |= sensor.hardware_ops != nullptr;
  for (const sim::ActuatorSpec& actuator : type.actuators) {
    real |= actuator.hardware_ops != nullptr;
  }
  // A robot without any hardware is simulated even if it has no actuator, such as a fixed camera.
  type.simulated = !real;
  for (const sim::ActuatorSpec& actuator : type.actuators) {
    // A simulated body may have recorded or real sensors; its actuator decides.
    if (actuator.virtual_ops != nullptr) type.simulated = true;
  }
  RAVE_TRY(check_ages(context, group, type));
  return set_pose_source(group, type);
}

}  // namespace rave::runtime
