// SPDX-License-Identifier: Apache-2.0
// What observers read between two steps.
#include <algorithm>

#include "engine_impl.hpp"
#include "plugin_call.hpp"
#include "rave/base/check.hpp"

namespace rave::sim {

const EngineSpec& Engine::spec() const noexcept { return impl_->spec; }
std::uint64_t Engine::steps_done() const noexcept { return impl_->step; }
SimTime Engine::time() const noexcept { return impl_->truth.snapshot.time(); }
const world::Snapshot& Engine::snapshot() const noexcept { return impl_->truth.snapshot; }
const ReportedPose& Engine::reported(RobotId robot) const noexcept {
  return impl_->reported[robot.value()];
}
Pose2 Engine::true_pose(RobotId robot) const noexcept {
  return impl_->truth.movers[robot.value()].X_WR;
}
bool Engine::is_local(RobotId robot) const noexcept { return impl_->roster.is_local(robot); }
// Of one of several hosts the last complete step: the present one is still being computed.
std::span<const Event> Engine::events() const noexcept {
  return impl_->host ? impl_->host->events : impl_->events;
}
RunHash Engine::hash() const noexcept { return impl_->host ? impl_->host->hash : impl_->hash; }
const PhaseTimes& Engine::phase_times() const noexcept { return impl_->phase_times; }

MapView Engine::program_map(RobotId robot) const noexcept {
  MapView view;
  const RobotGroup& group = impl_->roster.group_of(robot);
  const ProgramSlots& program = group.program;
  if (program.spec == nullptr || program.spec->isolate || program.spec->ops->map == nullptr ||
      !is_local(robot)) {
    return view;
  }
  const std::size_t m = impl_->roster.member_of(robot);
  if (program.failed[m] == 0) program.spec->ops->map(program.instances.at(m), &view);
  return view;
}

SensorSample Engine::sensor(RobotId robot, std::uint32_t index) const noexcept {
  const RobotGroup& group = impl_->roster.group_of(robot);
  const SensorSlots& slots = group.sensors[index];
  const std::size_t m = impl_->roster.member_of(robot);
  SensorSample sample{
      &slots.info, &slots.headers[m], slots.records.data() + std::size_t{slots.stride} * m, {}};
  if (slots.uses_fan) {
    sample.bodies =
        std::span(slots.bodies).subspan(std::size_t{slots.capacity} * m, slots.capacity);
  }
  return sample;
}

SensorParts Engine::sensor_parts(RobotId robot, std::uint32_t index) const noexcept {
  const SensorSlots& slots = impl_->roster.group_of(robot).sensors[index];
  if (!slots.fusion) return {};
  return slots.fusion->parts_of(impl_->roster.member_of(robot));
}

Command Engine::command(RobotId robot, std::uint32_t controller) const noexcept {
  return impl_->roster.group_of(robot).controllers[controller].last[impl_->roster.member_of(robot)];
}

std::int64_t Engine::command_step(RobotId robot, std::uint32_t controller) const noexcept {
  const ControllerSlots& slots = impl_->roster.group_of(robot).controllers[controller];
  return slots.last_step[impl_->roster.member_of(robot)];
}

const Command& Engine::actuator_command(RobotId robot, std::uint32_t actuator) const noexcept {
  return impl_->roster.group_of(robot).actuators[actuator].commands[impl_->roster.member_of(robot)];
}

std::uint32_t Engine::group_count() const noexcept {
  return static_cast<std::uint32_t>(impl_->roster.groups.size());
}

std::span<const RobotId> Engine::members(std::uint32_t group) const noexcept {
  return impl_->roster.groups[group].members;
}

const RobotType& Engine::type_of(std::uint32_t group) const noexcept {
  return *impl_->roster.groups[group].type;
}

SampleColumns Engine::samples(std::uint32_t group, std::uint32_t sensor) const noexcept {
  const SensorSlots& slots = impl_->roster.groups[group].sensors[sensor];
  return {slots.headers, slots.records.data(), slots.stride};
}

CommandColumns Engine::commands(std::uint32_t group, std::uint32_t controller) const noexcept {
  const ControllerSlots& slots = impl_->roster.groups[group].controllers[controller];
  return {slots.last, slots.last_step};
}

std::span<const Command> Engine::actuator_commands(std::uint32_t group,
                                                   std::uint32_t actuator) const noexcept {
  return impl_->roster.groups[group].actuators[actuator].commands;
}

std::uint64_t Engine::commands_given(RobotId robot) const noexcept {
  return impl_->roster.group_of(robot).program.given[impl_->roster.member_of(robot)];
}

bool Engine::obeys(RobotId robot) const noexcept {
  const std::size_t m = impl_->roster.member_of(robot);
  const auto& actuators = impl_->roster.group_of(robot).actuators;
  return !actuators.empty() && std::all_of(actuators.begin(), actuators.end(),
                                           [&](const auto& slots) { return slots.obeys[m] != 0; });
}

bool Engine::program_alive(RobotId robot) const noexcept {
  const RobotGroup& group = impl_->roster.group_of(robot);
  return group.program.spec != nullptr && group.program.failed[impl_->roster.member_of(robot)] == 0;
}

std::string Engine::sensor_report(RobotId robot, std::uint32_t index) const {
  const SensorSlots& slots = impl_->roster.group_of(robot).sensors[index];
  if (slots.is_virtual()) return "{}";
  return report_of(*slots.spec->hardware_ops, slots.instances.at(impl_->roster.member_of(robot)));
}

std::string Engine::device_report(RobotId robot, std::uint32_t index) const {
  const DeviceSlots& slots = impl_->roster.group_of(robot).devices[index];
  return report_of(*slots.spec->ops, slots.instances.at(impl_->roster.member_of(robot)));
}

void Engine::flip_percept_bit(RobotId robot, std::uint32_t sensor) noexcept {
  RAVE_CHECK(is_local(robot));
  RobotGroup& group = impl_->roster.group_of(robot);
  group.sensors[sensor].flip[impl_->roster.member_of(robot)] = 1;
}

double Engine::body_radius_m(RobotId robot) const noexcept {
  return impl_->truth.radius_m[robot.value()];
}

}  // namespace rave::sim
