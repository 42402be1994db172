// SPDX-License-Identifier: Apache-2.0
// The end of an engine, which a driver that never opens or never closes does not hold up.
#include <utility>

#include "engine_impl.hpp"
#include "radio.hpp"

namespace rave::sim {
namespace {

/// What the threads that are left behind run in: they make, configure and open all that the type
/// has.
void keep_loaded(const EngineSpec& spec, const RobotType& type) {
  if (spec.keep_loaded == nullptr) return;
  const auto keep = [&spec](const void* ops) {
    if (ops != nullptr) spec.keep_loaded(ops);
  };
  for (const DeviceSpec& device : type.devices) keep(device.ops);
  for (const SensorSpec& sensor : type.sensors) {
    keep(sensor.virtual_ops);
    keep(sensor.hardware_ops);
    if (!sensor.hybrid) continue;
    keep(sensor.hybrid->ops);
    keep(sensor.hybrid->virtual_ops);
  }
  for (const ActuatorSpec& actuator : type.actuators) {
    keep(actuator.virtual_ops);
    keep(actuator.hardware_ops);
  }
  for (const TransmitterSpec& transmitter : type.transmitters) keep(transmitter.ops);
}

}  // namespace

Engine::Engine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Engine::~Engine() {
  if (impl_->shut()) return;
  // It is what the threads that were left behind work with, for as long as the process is there.
  static_cast<void>(impl_.release());
}

Engine::Impl::~Impl() { static_cast<void>(shut()); }

/// Closes all. False: drivers that do not come to an end still use this engine.
bool Engine::Impl::shut() noexcept {
  if (std::exchange(is_shut, true)) return true;
  tell_complaints();
  halt();
  // What serves first: an open() that still runs may take long.
  bool all = close_all(take_open());
  all = hand_overs.close() && all;
  if (radio) all = close_all(radio->take_open()) && all;
  if (!all) leave_behind();
  return all;
}

std::vector<ToClose> Engine::Impl::take_open() {
  std::vector<ToClose> drivers;
  for (RobotGroup& group : roster.groups) {
    const std::vector<ToClose> open = sim::take_open(group);
    drivers.insert(drivers.end(), open.begin(), open.end());
  }
  return drivers;
}

bool Engine::Impl::close_all(std::vector<ToClose> drivers) {
  for (ToClose& driver : drivers)
    driver.robot_name = spec.robots[driver.robot.value()].name.c_str();
  for (const ToClose& driver : close_within(std::move(drivers), spec.last_wait, this)) {
    is_in_use = true;
    const std::uint32_t r = driver.robot.value();
    keep_loaded(spec, *roster.group_of(RobotId(r)).type);
    if (const RobotType* const other = hand_overs.other_type(driver.robot))
      keep_loaded(spec, *other);
    if (spec.log == nullptr) continue;
    spec.log->error(roster.logs[r].source,
                    "{} `{}` (driver `{}`) is still closing; the run ends without it", driver.kind,
                    driver.name, driver.driver);
  }
  return !is_in_use;
}

/// A driver that has not closed continues in a thread of its own, with this engine and nothing else
/// of the run.
void Engine::Impl::leave_behind() noexcept {
  hand_overs.leave_behind([this](const RobotType& type) { keep_loaded(spec, type); });
  // Programs and controllers, which no driver uses, end here as they would anyway. Of sensors the
  // threads may still read where their rays point.
  for (RobotGroup& group : roster.groups) {
    group.program.processes.clear();
    group.program.instances.clear();
    for (ControllerSlots& controller : group.controllers) controller.instances.clear();
  }
  // Log and clock belong to the caller and end after this. Drivers that still run find nothing
  // there.
  log_outlet.cut();
  if (clock_outlet) clock_outlet->cut();
}

}  // namespace rave::sim
