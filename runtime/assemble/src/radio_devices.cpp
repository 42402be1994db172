// SPDX-License-Identifier: Apache-2.0
#include "device_tools.hpp"

namespace rave::runtime {
namespace {

using plugin::Driver;

Status add_transmitter(const DeviceContext& context, const config::RobotGroup& group,
                       const config::TransmitterFile& file, sim::RobotType& type) {
  sim::TransmitterSpec transmitter;
  RAVE_TRY_ASSIGN(const Driver* const driver,
                  begin_device(context, DriverKind::kTransmitter, file, transmitter));
  if (file.device) {
    return fail_at(file.device->where, ErrorCode::kInvalidArgument,
                   "the driver `{}` does not use a device: expected no `device:`",
                   driver->info.name);
  }
  RAVE_TRY_ASSIGN(transmitter.params, read_params(*driver, file.params));
  note_clock(context, group, transmitter.name, driver->info, transmitter.params);
  type.transmitters.push_back(std::move(transmitter));
  return {};
}

Status add_communicator(const DeviceContext& context, const config::CommunicatorFile& file,
                        sim::RobotType& type) {
  sim::CommunicatorSpec communicator;
  RAVE_TRY_ASSIGN(const Driver* const driver,
                  begin_device(context, DriverKind::kCommunicator, file, communicator));
  RAVE_TRY_ASSIGN(communicator.params, read_params(*driver, file.params));
  // The reader of the file has checked that the name exists.
  for (std::uint32_t t = 0; t < type.transmitters.size(); ++t) {
    if (type.transmitters[t].name == file.transmitter.value) communicator.transmitter = t;
  }
  type.communicators.push_back(std::move(communicator));
  return {};
}

}  // namespace

Status add_radio(const DeviceContext& context, const config::RobotGroup& group,
                 sim::RobotType& type) {
  for (const config::TransmitterFile& file : group.robot.transmitters) {
    RAVE_TRY(add_transmitter(context, group, file, type));
  }
  for (const config::CommunicatorFile& file : group.robot.communicators) {
    RAVE_TRY(add_communicator(context, file, type));
  }
  return {};
}

}  // namespace rave::runtime
