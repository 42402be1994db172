// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "rave/plugin/registry.hpp"
#include "rave/plugin/stamp.hpp"
#include "rave/robot/actuator.hpp"
#include "rave/robot/communicator.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/device.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/hybrid_sensor.hpp"
#include "rave/robot/interface_hash.hpp"
#include "rave/robot/program.hpp"
#include "rave/robot/transmitter.hpp"

namespace rave {

/// The description of a driver by its author: `{.name = "wander", .version = "1.0", .summary =
/// "...", .params = kParams}`. All texts and lists must be constants of the plug-in.
struct Description {
  const char* name = "";
  const char* version = "1.0";
  const char* summary = "";
  std::span<const ParamSpec> params = {};
  DriverClock clock = DriverClock::kStepped;
  /// Sensors and actuators: the device driver of this plug-in that `device:` must name; empty:
  /// none.
  const char* device = "";
  /// Hardware sensors: when their samples come.
  SampleTiming timing = SampleTiming::kUnknown;

  [[nodiscard]] DriverInfo info(DriverKind kind, std::uint32_t data_kind) const noexcept {
    DriverInfo info;
    info.kind = kind;
    info.clock = clock;
    info.name = name;
    info.version = version;
    info.summary = summary;
    info.params = params.data();
    info.param_count = params.size();
    info.data_kind = data_kind;
    info.timing = timing;
    info.device = device;
    return info;
  }
};

/// Registers a decision process.
template <class T>
void add_program(RegistrySink& registry, const Description& description) {
  static constexpr ProgramOps kOps = detail::program_ops<T>();
  registry.add(description.info(DriverKind::kProgram, 0), &kOps);
}

/// Registers a controller. T::kAccepts and T::kGives are its command kinds.
template <class T>
void add_controller(RegistrySink& registry, const Description& description) {
  static constexpr ControllerOps kOps = detail::controller_ops<T>();
  registry.add(description.info(DriverKind::kController, static_cast<std::uint32_t>(T::kAccepts)),
               &kOps);
}

/// Registers a virtual actuator. T::kAccepts is its command kind.
template <class T>
void add_virtual_actuator(RegistrySink& registry, const Description& description) {
  static constexpr VirtualActuatorOps kOps = detail::virtual_actuator_ops<T>();
  registry.add(
      description.info(DriverKind::kVirtualActuator, static_cast<std::uint32_t>(T::kAccepts)),
      &kOps);
}

/// Registers a hardware actuator. T::kAccepts is its command kind.
template <class T>
void add_actuator(RegistrySink& registry, const Description& description) {
  static constexpr HardwareActuatorOps kOps = detail::hardware_actuator_ops<T>();
  registry.add(description.info(DriverKind::kActuator, static_cast<std::uint32_t>(T::kAccepts)),
               &kOps);
}

/// Registers a hardware sensor. T::kReading is the kind of its records.
template <class T>
void add_sensor(RegistrySink& registry, const Description& description) {
  static constexpr HardwareSensorOps kOps = detail::hardware_sensor_ops<T>();
  registry.add(description.info(DriverKind::kSensor, static_cast<std::uint32_t>(T::kReading)),
               &kOps);
}

/// Registers hardware that sensors and actuators of this plug-in share.
template <class T>
void add_device(RegistrySink& registry, const Description& description) {
  static constexpr HardwareDeviceOps kOps = detail::hardware_device_ops<T>();
  registry.add(description.info(DriverKind::kDevice, 0), &kOps);
}

/// Registers a hybrid sensor: a rule that fuses a real and a virtual reading of kind T::kReading.
template <class T>
void add_hybrid_sensor(RegistrySink& registry, const Description& description) {
  static constexpr HybridSensorOps kOps = detail::hybrid_sensor_ops<T>();
  registry.add(description.info(DriverKind::kHybridSensor, static_cast<std::uint32_t>(T::kReading)),
               &kOps);
}

/// Registers a message model.
template <class T>
void add_communicator(RegistrySink& registry, const Description& description) {
  static constexpr CommunicatorOps kOps = detail::communicator_ops<T>();
  registry.add(description.info(DriverKind::kCommunicator, 0), &kOps);
}

/// Registers a device that carries messages.
template <class T>
void add_transmitter(RegistrySink& registry, const Description& description) {
  static constexpr TransmitterOps kOps = detail::transmitter_ops<T>();
  registry.add(description.info(DriverKind::kTransmitter, 0), &kOps);
}

}  // namespace rave

/// Begins the function that registers the drivers of a plug-in; use it exactly once:
/// `RAVE_PLUGIN("wander") { rave::add_program<Wander>(registry, {...}); }`. The text lists the
/// names of all drivers, separated by blanks.
#define RAVE_PLUGIN_WITH_STAMP_(stamp)                                                         \
  static void rave_register_drivers(::rave::RegistrySink& registry);                           \
  extern "C" {                                                                                 \
  extern __attribute__((visibility("default"))) const ::rave::plugin::Stamp rave_plugin_stamp; \
  __attribute__((section(".rave_stamp"), used, aligned(8)))                                    \
  const ::rave::plugin::Stamp rave_plugin_stamp = stamp;                                       \
  __attribute__((visibility("default"))) void rave_register_plugin(                            \
      ::rave::RegistrySink* registry);                                                         \
  __attribute__((visibility("default"))) void rave_register_plugin(                            \
      ::rave::RegistrySink* registry) {                                                        \
    rave_register_drivers(*registry);                                                          \
  }                                                                                            \
  }                                                                                            \
  static void rave_register_drivers([[maybe_unused]] ::rave::RegistrySink& registry)

#define RAVE_PLUGIN(provides) \
  RAVE_PLUGIN_WITH_STAMP_(::rave::plugin::make_stamp(::rave::robot_interface_hash(), 0, provides))
