// SPDX-License-Identifier: Apache-2.0
// Who of a group is open, and has to be closed.
#include <vector>

#include "closing.hpp"
#include "robot_group.hpp"

namespace rave::sim {
namespace {

/// Adds those of the drivers that are open, as `describe(spec)` has them; from now on they are not.
/// After a start that failed there may be slots for what was never made.
template <class Slots, class Describe>
void take_open(const RobotGroup& group, Slots& slots, std::vector<ToClose>& drivers,
               Describe describe) {
  for (std::size_t m = 0; m < slots.open.size(); ++m) {
    if (slots.open[m] == 0) continue;
    slots.open[m] = 0;
    ToClose& driver = drivers.emplace_back(describe(*slots.spec));
    driver.robot = group.members[m];
    driver.name = slots.spec->name.c_str();
    driver.instance = slots.instances.at(m);
  }
}

ToClose describe_sensor(const SensorSpec& spec) {
  return {.kind = "sensor",
          .driver = spec.hardware_driver().c_str(),
          .close = spec.hardware_ops->close};
}
ToClose describe_actuator(const ActuatorSpec& spec) {
  return {.kind = "actuator", .driver = spec.driver.c_str(), .close = spec.hardware_ops->close};
}
/// The actuators of a robot with a guard stay open if that hangs in one of their drivers.
void take_actuators(RobotGroup& group, std::vector<ToClose>& drivers) {
  for (ActuatorSlots& slots : group.actuators) {
    take_open(group, slots, drivers, [&group](const ActuatorSpec& spec) {
      ToClose actuator = describe_actuator(spec);
      actuator.is_shared = !group.guards.empty();
      return actuator;
    });
  }
}

/// The threads of guards, which stop writing from now on.
void take_guards(RobotGroup& group, std::vector<ToClose>& drivers) {
  for (std::size_t m = 0; m < group.guards.size(); ++m) {
    GuardThread* const thread = group.guards[m].thread.get();
    if (thread == nullptr || !thread->retire()) continue;
    ToClose& guard = drivers.emplace_back();
    guard.robot = group.members[m];
    guard.kind = "the guard of actuator";
    guard.name = group.type->actuators.front().name.c_str();
    guard.driver = group.type->actuators.front().driver.c_str();
    guard.close = [](void* instance) { static_cast<GuardThread*>(instance)->join(); };
    guard.instance = thread;
  }
}

ToClose describe_device(const DeviceSpec& spec) {
  return {
      .kind = "device", .driver = spec.driver.c_str(), .close = spec.ops->close, .is_shared = true};
}

}  // namespace

std::vector<ToClose> take_open(RobotGroup& group) {
  std::vector<ToClose> drivers;
  if (!group.guards.empty()) {
    // Before anything else of these robots: a sensor that hangs does not keep wheels from stopping.
    take_guards(group, drivers);
    take_actuators(group, drivers);
  }
  for (SensorSlots& slots : group.sensors) {
    for (auto& queue : slots.queues) queue->close();
    take_open(group, slots, drivers, describe_sensor);
  }
  take_actuators(group, drivers);
  for (DeviceSlots& slots : group.devices) take_open(group, slots, drivers, describe_device);
  return drivers;
}

void close_group(RobotGroup& group) noexcept {
  for (const ToClose& driver : take_open(group)) driver.close(driver.instance);
}

}  // namespace rave::sim
