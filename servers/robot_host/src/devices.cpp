// SPDX-License-Identifier: Apache-2.0
#include "devices.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "device_tools.hpp"
#include "hybrid_device.hpp"
#include "rave/base/names.hpp"
#include "rave/isolation/isolated_program.hpp"
#include "rave/math/scalar.hpp"
#include "shared_device.hpp"

namespace rave::robot_host {
namespace {

using plugin::Driver;

struct AddValue {
  plugin::ParamSet& set;
  const std::string& name;

  void operator()(bool value) const { set.add_number(name, value ? 1 : 0); }
  void operator()(std::int64_t value) const { set.add_number(name, static_cast<double>(value)); }
  void operator()(double value) const { set.add_number(name, value); }
  void operator()(const std::string& value) const { set.add_text(name, value); }
  void operator()(const std::vector<double>& value) const { set.add_list(name, value); }
};

}  // namespace

Result<plugin::ParamSet> read_params(const Driver& driver, const config::RawNode& params) {
  const auto specs = field_specs(driver.info);
  RAVE_TRY_ASSIGN(const auto values,
                  config::read_params(params, specs, fmt::format("driver `{}`", driver.info.name)));
  plugin::ParamSet set;
  for (const config::Param& param : values.all()) {
    std::visit(AddValue{set, param.name}, param.value);
  }
  return set;
}

Result<plugin::ParamSet> read_sensor_params(const DeviceContext& context, const Driver& driver,
                                            const config::RawNode& params) {
  constexpr std::string_view kOrigin = "geo_origin";
  const auto& origin = context.scenario.scenario.geo_origin;
  const auto specs = driver.info.param_specs();
  const bool wants = std::any_of(specs.begin(), specs.end(),
                                 [&](const ParamSpec& spec) { return spec.name == kOrigin; });
  if (!wants || !origin || params.find(kOrigin) != nullptr) return read_params(driver, params);
  config::RawNode numbers = config::RawNode::sequence();
  for (const double number :
       {origin->latitude_deg, origin->longitude_deg, origin->altitude_m, origin->yaw_deg}) {
    numbers.push_back(config::RawNode::number(number));
  }
  config::RawNode all = params.is_mapping() ? params : config::RawNode::mapping();
  all.append(std::string(kOrigin), std::move(numbers));
  return read_params(driver, all);
}

Result<const Driver*> find_driver(const DeviceContext& context, std::span<const DriverKind> kinds,
                                  const config::Located<std::string>& name) {
  auto driver = context.catalogue.find(kinds, name.value);
  if (driver) return driver;
  Error error = std::move(driver).error();
  if (error.where.file.empty()) error.where = name.where;
  return tl::unexpected(std::move(error));
}

LayerMask layer_mask(const std::vector<config::SensedLayer>& layers) {
  LayerMask mask = 0;
  for (const config::SensedLayer layer : layers) {
    switch (layer) {
      case config::SensedLayer::kVirtualObstacles:
        mask |= static_cast<LayerMask>(Layer::kVirtualObstacles);
        break;
      case config::SensedLayer::kMappedReal:
        mask |= static_cast<LayerMask>(Layer::kMappedReal);
        break;
      case config::SensedLayer::kSimulatedRobots:
        mask |= static_cast<LayerMask>(Layer::kSimulatedRobots);
        break;
      case config::SensedLayer::kRealRobots:
        mask |= static_cast<LayerMask>(Layer::kRealRobots);
        break;
    }
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
  if (info.clock == DriverClock::kEither) {
    live = Params(params.values()).text("clock") == "live";
  }
  if (live && context.built.live_reason.empty()) {
    context.built.live_reason = fmt::format(
        "`{}` of robot `{}` uses the driver `{}` by the wall "
        "clock",
        device, group.name.value, info.name);
  }
}

namespace {

std::uint32_t in_steps(const DeviceContext& context,
                       const std::optional<config::Located<double>>& time_s) {
  if (!time_s) return 1;
  return static_cast<std::uint32_t>(
      std::lround(time_s->value / context.scenario.scenario.step_s.value));
}

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
  constexpr std::array kKinds = {DriverKind::kDevice};
  for (const config::DeviceFile& file : group.robot.devices) {
    RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
    sim::DeviceSpec device;
    device.name = file.name.value;
    device.driver = driver->info.name;
    device.ops = static_cast<const HardwareDeviceOps*>(driver->ops);
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
  if (driver->info.kind == DriverKind::kHybridSensor) {
    return fail_at(file.driver.where, ErrorCode::kInvalidArgument,
                   "the driver `{}` of sensor `{}` fuses two halves: expected `real:` and "
                   "`virtual:`, each with a `driver`",
                   driver->info.name, sensor.name);
  }
  sensor.kind = static_cast<ReadingKind>(driver->info.data_kind);
  if (driver->info.kind == DriverKind::kVirtualSensor) {
    sensor.virtual_ops = static_cast<const VirtualSensorOps*>(driver->ops);
  } else {
    sensor.hardware_ops = static_cast<const HardwareSensorOps*>(driver->ops);
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
  sensor.period_steps = in_steps(context, file.period_s);
  sensor.phase_steps = file.phase_s.value == 0 ? 0 : in_steps(context, file.phase_s);
  sensor.processing = processing_of(file);
  return sensor;
}

Status add_actuators(const DeviceContext& context, const config::RobotGroup& group,
                     sim::RobotType& type) {
  constexpr std::array kKinds = {DriverKind::kActuator, DriverKind::kVirtualActuator};
  const config::ActuatorFile* hardware = nullptr;
  const config::ActuatorFile* simulated = nullptr;
  for (const config::ActuatorFile& file : group.robot.actuators) {
    RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
    sim::ActuatorSpec actuator;
    actuator.name = file.name.value;
    actuator.driver = driver->info.name;
    if (driver->info.kind == DriverKind::kVirtualActuator) {
      if (simulated != nullptr) {
        return fail_at(file.name.where, ErrorCode::kInvalidArgument,
                       "actuators `{}` and `{}` both move the body; one can", simulated->name.value,
                       actuator.name);
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
                   "actuator `{}` is simulated and `{}` is real; a robot is the one or the other",
                   simulated->name.value, hardware->name.value);
  }
  return {};
}

Status add_controllers(const DeviceContext& context, const config::RobotGroup& group,
                       sim::RobotType& type) {
  constexpr std::array kKinds = {DriverKind::kController};
  for (const config::ControllerFile& file : group.robot.controllers) {
    RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
    sim::ControllerSpec controller;
    controller.name = file.name.value;
    controller.driver = driver->info.name;
    controller.ops = static_cast<const ControllerOps*>(driver->ops);
    controller.accepts = static_cast<CommandKind>(driver->info.data_kind);
    for (std::uint32_t a = 0; a < type.actuators.size(); ++a) {
      if (type.actuators[a].name == file.actuator.value) controller.actuator = a;
    }
    const sim::ActuatorSpec& actuator = type.actuators[controller.actuator];
    const auto actuator_kinds = std::array{DriverKind::kActuator, DriverKind::kVirtualActuator};
    RAVE_TRY_ASSIGN(const Driver* const served,
                    context.catalogue.find(actuator_kinds, actuator.driver));
    const auto wanted = static_cast<CommandKind>(served->info.data_kind);
    if (controller.ops->gives != wanted) {
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

/// Adapts a program in a process of its own to what the engine asks for.
class Isolated final : public sim::ProgramProcess {
 public:
  explicit Isolated(std::unique_ptr<isolation::IsolatedProgram> program)
      : program_(std::move(program)) {}
  Status begin(const DecideItem& item) override { return program_->begin_decide(item); }
  Status end(const DecideItem& item) override { return program_->end_decide(item); }
  Status update(std::span<const ParamValue> params, double radius_m) override {
    return program_->update(params, radius_m);
  }

 private:
  std::unique_ptr<isolation::IsolatedProgram> program_;
};

sim::ProgramProcessFactory isolated_factory(const DeviceContext& context, const Driver& driver) {
  isolation::IsolationOptions options;
  options.runner = context.options.program_runner;
  options.plugin = driver.file;
  options.program = driver.info.name;
  return [options](const ProgramSetup& setup) -> Result<std::unique_ptr<sim::ProgramProcess>> {
    RAVE_TRY_ASSIGN(auto program, isolation::IsolatedProgram::start(options, setup));
    return std::make_unique<Isolated>(std::move(program));
  };
}

Status add_program(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type) {
  if (!group.robot.program) return {};
  const config::ProgramFile& file = *group.robot.program;
  constexpr std::array kKinds = {DriverKind::kProgram};
  RAVE_TRY_ASSIGN(const Driver* const driver, find_driver(context, kKinds, file.driver));
  sim::ProgramSpec program;
  program.driver = driver->info.name;
  program.ops = static_cast<const ProgramOps*>(driver->ops);
  RAVE_TRY_ASSIGN(program.params, read_params(*driver, file.params));
  program.param_specs = driver->info.param_specs();
  program.period_steps = in_steps(context, file.period_s);
  program.phase_steps = file.phase_s.value == 0 ? 0 : in_steps(context, file.phase_s);
  if (file.isolate) program.isolate = isolated_factory(context, *driver);
  type.program = std::move(program);
  return {};
}

Status set_pose_source(const config::RobotGroup& group, sim::RobotType& type) {
  if (!group.robot.pose_from) {
    if (type.simulated) return {};
    return fail_at(group.robot.body.where, ErrorCode::kInvalidArgument,
                   "robot `{}` is real, so others can sense it only if something says where it is: "
                   "expected `pose_from:` with the name of a sensor that gives a pose or odometry",
                   group.name.value);
  }
  const config::Located<std::string>& name = *group.robot.pose_from;
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
                     "`{}`) is a hybrid: its virtual half would be asked for the pose that it "
                     "depends on; name the real half as a sensor of its own",
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
  if (frame != config::PoseFile{}) {
    type.X_WM = Pose2{frame.x_m, frame.y_m, wrap_angle(deg_to_rad(frame.yaw_deg))};
  }
  return {};
}

}  // namespace

config::FieldSpec field_spec(const ParamSpec& spec) {
  config::FieldSpec field;
  field.name = spec.name;
  field.doc = spec.doc;
  field.unit = spec.unit;
  const bool numeric = spec.type == ParamType::kInteger || spec.type == ParamType::kNumber ||
                       spec.type == ParamType::kNumbers;
  if (numeric && std::isfinite(spec.min)) field.min = spec.min;
  if (numeric && std::isfinite(spec.max)) field.max = spec.max;
  switch (spec.type) {
    case ParamType::kBool:
      field.type = config::ParamType::kBool;
      field.default_value = spec.default_number != 0;
      break;
    case ParamType::kInteger:
      field.type = config::ParamType::kInt;
      field.default_value = static_cast<std::int64_t>(spec.default_number);
      break;
    case ParamType::kNumber:
      field.type = config::ParamType::kDouble;
      field.default_value = spec.default_number;
      break;
    case ParamType::kText:
      field.type = config::ParamType::kString;
      field.default_value = std::string(spec.default_text);
      break;
    case ParamType::kChoice:
      field.type = config::ParamType::kEnum;
      field.choices.assign(spec.choices, spec.choices + spec.choice_count);
      field.default_value = std::string(spec.default_text);
      break;
    case ParamType::kNumbers:
      field.type = config::ParamType::kDoubleList;
      field.default_value = std::vector<double>{};
      break;
  }
  if (spec.required != 0) field.default_value.reset();
  return field;
}

std::vector<config::FieldSpec> field_specs(const DriverInfo& info) {
  std::vector<config::FieldSpec> fields;
  for (const ParamSpec& spec : info.param_specs()) fields.push_back(field_spec(spec));
  return fields;
}

Status add_devices(const DeviceContext& context, const config::RobotGroup& group,
                   sim::RobotType& type) {
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
  type.simulated = !real;
  for (const sim::ActuatorSpec& actuator : type.actuators) {
    // A simulated body may carry a recorded or real sensor; what moves it decides.
    if (actuator.virtual_ops != nullptr) type.simulated = true;
  }
  return set_pose_source(group, type);
}

}  // namespace rave::robot_host
