// SPDX-License-Identifier: Apache-2.0
// From a robot type to instances of its drivers. The order is that of dependence: devices, sensors,
// controllers, actuators, program. Each call into a plug-in has a crash note, which names the robot
// and driver if it ends the process.
#include "robot_group.hpp"

#include <algorithm>
#include <utility>

#include "plugin_call.hpp"
#include "radio.hpp"
#include "robot_group_parts.hpp"

namespace rave::sim {

HostServices services_of(RobotLog& log) {
  HostServices services;
  services.context = &log;
  // A plain function and a pointer: nothing of C++ but the calling convention crosses the edge of a
  // plug-in.
  services.log = [](void* context, LogLevel level, const char* text, std::uint64_t size) {
    const auto* robot = static_cast<const RobotLog*>(context);
    if (robot->sink != nullptr) robot->sink->write(level, robot->source, {text, size});
  };
  return services;
}

CrashNote crash_note_of(const GroupContext& context, RobotId id, const char* part,
                        const std::string& driver) {
  const char* const robot = context.spec.robots[id.value()].name.c_str();
  return {part, driver.c_str(), robot, robot};
}

Status of_part(const RobotSpec& robot, const NamedPart& part, Status status) {
  if (status) return status;
  Error error = std::move(status).error();
  if (error.where.file.empty()) error.where = part.where;
  return tl::unexpected(std::move(error).with_context(fmt::format(
      "robot `{}`, {} `{}` (driver `{}`)", robot.name, part.kind, part.name, part.driver)));
}

DeviceSetup device_setup(const GroupContext& context, RobotId id, const plugin::ParamSet& params) {
  auto setup = setup_of<DeviceSetup>(context, id, params);
  setup.step_s = context.spec.step.seconds();
  return setup;
}

HardwareDevice* device_of(const RobotGroup& group, std::optional<std::uint32_t> index,
                          std::size_t member) {
  return index ? group.devices[*index].bases[member] : nullptr;
}

RobotInfo info_of(const GroupContext& context, RobotId id) {
  const RobotSpec& robot = context.spec.robots[id.value()];
  RobotInfo info;
  info.name = robot.name.c_str();
  info.team = robot.team.c_str();
  info.id = id.value();
  info.radius_m = context.spec.world.robots[id.value()].radius_m();
  info.seed = context.spec.seed;
  return info;
}

// Views are pointers into the columns of the sensors, so programs read samples without a copy.
void show_sensors(RobotGroup& group) {
  const std::size_t sensors = group.sensors.size();
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    for (std::size_t s = 0; s < sensors; ++s) {
      group.program.views[m * sensors + s] = {&group.sensors[s].headers[m],
                                              group.sensors[s].records_of(m)};
    }
  }
}

namespace {

Status configure_device(const GroupContext& context, RobotGroup& group, DeviceSlots& slots,
                        std::size_t member) {
  auto setup = setup_of<HardwareDeviceSetup>(context, group.members[member], slots.spec->params);
  setup.folder = group.type->folder.c_str();
  void* const instance = slots.instances.at(member);
  // What sensors and actuators of this device get, as the common base that they know.
  slots.bases.push_back(slots.spec->ops->base(instance));
  return called(
      [&](ErrorText* error) { return slots.spec->ops->configure(instance, &setup, error); });
}

Status make_devices(const GroupContext& context, RobotGroup& group) {
  group.devices.resize(group.type->devices.size());
  for (std::size_t d = 0; d < group.devices.size(); ++d) {
    DeviceSlots& slots = group.devices[d];
    slots.spec = &group.type->devices[d];
    RAVE_TRY(slots.instances.make(slots.spec->ops->instance, group.members.size()));
    slots.open.assign(group.members.size(), 0);
    for (std::size_t m = 0; m < group.members.size(); ++m) {
      RAVE_TRY(start_part(context, group.members[m], named_part("device", *slots.spec),
                          [&] { return configure_device(context, group, slots, m); }));
    }
  }
  return {};
}

Status open_devices(const GroupContext& context, RobotGroup& group) {
  for (DeviceSlots& slots : group.devices) {
    const NamedPart part = named_part("device", *slots.spec);
    for (std::size_t m = 0; m < group.members.size(); ++m) {
      // close() comes also after an error of open().
      slots.open[m] = 1;
      context.note(part);
      RAVE_TRY(start_part(context, group.members[m], part, [&] {
        return called(
            [&](ErrorText* error) { return slots.spec->ops->open(slots.instances.at(m), error); });
      }));
    }
  }
  return {};
}

Status start_controllers(const GroupContext& context, RobotGroup& group) {
  const std::size_t count = group.members.size();
  for (ControllerSlots& slots : group.controllers) {
    RAVE_TRY(slots.instances.make(slots.spec->ops->instance, count));
    slots.last.assign(count, Command{});
    // Never: no command has been given.
    slots.last_step.assign(count, -1);
    slots.changed.clear();
    slots.changed.resize(count);
    slots.failed.assign(count, 0);
    for (std::size_t m = 0; m < count; ++m) {
      const DeviceSetup setup = device_setup(context, group.members[m], slots.spec->params);
      RAVE_TRY(start_part(context, group.members[m], named_part("controller", *slots.spec), [&] {
        return called([&](ErrorText* error) {
          return slots.spec->ops->start(slots.instances.at(m), &setup, error);
        });
      }));
    }
  }
  return {};
}

Status start_actuator(const GroupContext& context, RobotGroup& group, ActuatorSlots& slots,
                      std::size_t m) {
  DeviceSetup setup = device_setup(context, group.members[m], slots.spec->params);
  setup.device = device_of(group, slots.spec->device, m);
  void* instance = slots.instances.at(m);
  if (slots.spec->virtual_ops != nullptr) {
    return called(
        [&](ErrorText* error) { return slots.spec->virtual_ops->start(instance, &setup, error); });
  }
  RAVE_TRY(called(
      [&](ErrorText* error) { return slots.spec->hardware_ops->open(instance, &setup, error); }));
  slots.open[m] = 1;
  slots.obeys[m] = slots.spec->hardware_ops->obeys(instance) != 0 ? 1 : 0;
  return {};
}

Status start_actuators(const GroupContext& context, RobotGroup& group) {
  const std::size_t count = group.members.size();
  for (ActuatorSlots& slots : group.actuators) {
    const InstanceOps& ops = slots.spec->virtual_ops != nullptr
                                 ? slots.spec->virtual_ops->instance
                                 : slots.spec->hardware_ops->instance;
    RAVE_TRY(slots.instances.make(ops, count));
    slots.changed.clear();
    slots.changed.resize(count);
    slots.commands.assign(count, Command{});
    slots.failed.assign(count, 0);
    slots.trouble.assign(count, {});
    // Virtual actuators obey. A real one says after it was opened, and a recorded one never does.
    slots.obeys.assign(count, 1);
    slots.open.assign(count, 0);
    const NamedPart part = named_part("actuator", *slots.spec);
    for (std::size_t m = 0; m < count; ++m) {
      context.note(part);
      RAVE_TRY(start_part(context, group.members[m], part,
                          [&] { return start_actuator(context, group, slots, m); }));
    }
  }
  return {};
}

void lay_out_program(const GroupContext& context, RobotGroup& group) {
  ProgramSlots& slots = group.program;
  const std::size_t count = group.members.size();
  const std::size_t sensors = group.sensors.size();
  const std::size_t controllers = group.controllers.size();
  group.robot_names.clear();
  for (const RobotSpec& robot : context.spec.robots)
    group.robot_names.push_back(robot.name.c_str());
  // The items below point into these arrays, so none of them may grow from here on.
  slots.commands.assign(count * controllers, Command{});
  slots.views.resize(count * sensors);
  slots.states.assign(count, 0);
  slots.items.assign(count, DecideItem{});
  slots.setups.assign(count, ProgramSetup{});
  slots.failed.assign(count, 0);
  slots.given.assign(count, 0);
  slots.changed.clear();
  slots.changed.resize(count);
  show_sensors(group);
  for (std::size_t m = 0; m < count; ++m) {
    DecideItem& item = slots.items[m];
    item.sensors = slots.views.data() + m * sensors;
    item.commands = slots.commands.data() + m * controllers;
    item.robot = group.members[m].value();
    item.seed = context.spec.seed;
    item.state = &slots.states[m];
    item.communicators = context.radio->views_of(group.members[m]);
    if (slots.spec == nullptr) continue;
    if (slots.spec->takes() != 0) item.answers = context.answers;
    ProgramSetup& setup = slots.setups[m];
    setup = setup_of<ProgramSetup>(context, group.members[m], slots.spec->params);
    setup.sensors = group.sensor_infos.data();
    setup.sensor_count = sensors;
    setup.controllers = group.controller_infos.data();
    setup.controller_count = controllers;
    setup.period_s = slots.spec->period_steps * context.spec.step.seconds();
    const auto communicators =
        context.radio->infos_of(context.spec.robots[group.members[m].value()].type);
    setup.communicators = communicators.data();
    setup.communicator_count = communicators.size();
    setup.robot_names = group.robot_names.data();
    setup.robot_count = group.robot_names.size();
  }
}

Status start_program(ProgramSlots& slots, std::size_t m) {
  if (slots.spec->isolate) {
    RAVE_TRY_ASSIGN(auto process, slots.spec->isolate(slots.setups[m]));
    slots.processes.push_back(std::move(process));
    return {};
  }
  return called([&](ErrorText* error) {
    return slots.spec->ops->start(slots.instances.at(m), &slots.setups[m], error);
  });
}

Status start_programs(const GroupContext& context, RobotGroup& group) {
  lay_out_program(context, group);
  ProgramSlots& slots = group.program;
  if (slots.spec == nullptr) return {};
  slots.processes.clear();
  slots.instances.clear();
  // All instances in one array with a fixed stride, so that a block is one call into the plug-in.
  if (!slots.spec->isolate) {
    RAVE_TRY(slots.instances.make(slots.spec->ops->instance, group.members.size()));
  }
  const NamedPart part = {"program", slots.spec->driver, slots.spec->driver, slots.spec->where};
  for (std::size_t m = 0; m < group.members.size(); ++m) {
    RAVE_TRY(start_part(context, group.members[m], part, [&] { return start_program(slots, m); }));
  }
  return {};
}

// Programs last: the sensors, controllers and radio that they look up must exist, and their
// first decision may command.
Status start_devices(const GroupContext& context, RobotGroup& group) {
  RAVE_TRY(open_devices(context, group));
  RAVE_TRY(start_controllers(context, group));
  RAVE_TRY(start_actuators(context, group));
  return start_programs(context, group);
}

}  // namespace

Status make_body(GroupContext context, RobotGroup& group) {
  RAVE_TRY(make_devices(context, group));
  group.sensors.resize(group.type->sensors.size());
  for (std::size_t s = 0; s < group.sensors.size(); ++s) {
    SensorSlots& slots = group.sensors[s];
    slots.spec = &group.type->sensors[s];
    RAVE_TRY(of_part(context.spec.robots[group.members.front().value()],
                     named_part("sensor", *slots.spec), make_sensor(context, group, slots)));
  }
  group.actuators.resize(group.type->actuators.size());
  for (std::size_t a = 0; a < group.actuators.size(); ++a) {
    group.actuators[a].spec = &group.type->actuators[a];
  }
  return {};
}

Status open_body(GroupContext context, RobotGroup& group) {
  clear_sensors(group);
  RAVE_TRY(open_devices(context, group));
  RAVE_TRY(start_actuators(context, group));
  return open_sensors(context, group);
}

Status make_group(GroupContext context, RobotGroup& group) {
  RAVE_TRY(make_body(context, group));
  // A copy, which stays when a hand-over exchanges the sensors: a program receives it only once.
  for (const SensorSlots& slots : group.sensors) group.sensor_infos.push_back(slots.info);
  group.controllers.resize(group.type->controllers.size());
  for (std::size_t c = 0; c < group.controllers.size(); ++c) {
    group.controllers[c].spec = &group.type->controllers[c];
    group.controller_infos.push_back(
        {group.controllers[c].spec->name.c_str(), group.controllers[c].spec->accepts, 0});
  }
  if (group.type->program) group.program.spec = &*group.type->program;
  return start_devices(context, group);
}

// The same instances are started again; only what start() and open() make is new.
Status reset_group(GroupContext context, RobotGroup& group) {
  clear_sensors(group);
  return start_devices(context, group);
}

}  // namespace rave::sim
