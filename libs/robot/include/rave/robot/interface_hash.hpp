// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "rave/base/hash.hpp"
#include "rave/plugin/registry.hpp"
#include "rave/robot/actuator.hpp"
#include "rave/robot/communicator.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/device.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/hybrid_sensor.hpp"
#include "rave/robot/program.hpp"
#include "rave/robot/transmitter.hpp"

namespace rave {

/// Increased by hand when the meaning of the interface changes but its layout does not.
inline constexpr std::uint64_t kRobotInterfaceVersion = 7;

namespace detail {
constexpr std::uint64_t hash_layout(std::uint64_t version,
                                    std::initializer_list<std::size_t> numbers) noexcept {
  std::uint64_t hash = mix64(version);
  for (const std::size_t number : numbers) hash = mix64(hash ^ number) + number;
  return hash;
}
}  // namespace detail

/// A number that depends on the layout of all types that cross the plug-in interface.
constexpr std::uint64_t robot_interface_hash() noexcept {
  return detail::hash_layout(kRobotInterfaceVersion, {sizeof(DriverInfo),
                                                      offsetof(DriverInfo, param_count),
                                                      sizeof(ParamSpec),
                                                      offsetof(ParamSpec, choices),
                                                      sizeof(ParamValue),
                                                      sizeof(ErrorText),
                                                      sizeof(HostServices),
                                                      sizeof(RobotInfo),
                                                      offsetof(RobotInfo, seed),
                                                      sizeof(InstanceOps),
                                                      sizeof(SensorInfo),
                                                      offsetof(SensorInfo, bearings_rad),
                                                      sizeof(SampleHeader),
                                                      sizeof(Sighting),
                                                      sizeof(PoseReading),
                                                      sizeof(OdometryReading),
                                                      sizeof(NeighbourReading),
                                                      sizeof(ContactReading),
                                                      sizeof(VelocityReading),
                                                      sizeof(Command),
                                                      sizeof(ControllerInfo),
                                                      sizeof(SensorView),
                                                      sizeof(ProgramSetup),
                                                      offsetof(ProgramSetup, period_s),
                                                      sizeof(DecideItem),
                                                      offsetof(DecideItem, pose),
                                                      offsetof(DecideItem, orders),
                                                      offsetof(DecideItem, state),
                                                      sizeof(MapView),
                                                      sizeof(OrderItem),
                                                      sizeof(AnswerService),
                                                      sizeof(ProgramOps),
                                                      sizeof(DeviceSetup),
                                                      sizeof(ControlInput),
                                                      offsetof(ControlInput, velocity),
                                                      sizeof(ControllerOps),
                                                      sizeof(MotionInput),
                                                      sizeof(DriveOps),
                                                      sizeof(VirtualActuatorOps),
                                                      sizeof(HardwareActuatorOps),
                                                      sizeof(HardwareSetup),
                                                      sizeof(HardwareDeclaration),
                                                      sizeof(HardwareSensorOps),
                                                      sizeof(HardwareDeviceSetup),
                                                      sizeof(HardwareDeviceOps),
                                                      sizeof(HybridSetup),
                                                      sizeof(FuseItem),
                                                      sizeof(HybridSensorOps),
                                                      sizeof(MessageHead),
                                                      sizeof(Mailbox),
                                                      sizeof(CommunicatorView),
                                                      sizeof(CommunicatorInfo),
                                                      sizeof(RadioDeclaration),
                                                      sizeof(LinkQuery),
                                                      sizeof(LinkAnswer),
                                                      sizeof(CommunicatorOps),
                                                      sizeof(TransmitterDeclaration),
                                                      sizeof(TransmitterOps)});
}

}  // namespace rave
