// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// Turns a hybrid sensor of a robot file (`real:` and `virtual:`) into `sensor`: drivers, their
/// parameters, the noise of each half and the layers that the virtual half senses. Mounting, times
/// and processing are for the caller. Errors: kNotFound and kInvalidArgument with file, line and
/// column: a driver that does not exist, or halves that do not give what the driver fuses.
Status set_hybrid(const DeviceContext& context, const config::RobotGroup& group,
                  const config::SensorFile& file, const sim::RobotType& type,
                  sim::SensorSpec& sensor);

}  // namespace rave::runtime
