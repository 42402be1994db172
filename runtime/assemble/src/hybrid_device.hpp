// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// Converts a hybrid sensor of a robot file (`real:` and `virtual:`): drivers, their parameters,
/// the noise of each half and the layers of the virtual half. The caller sets mount, times and
/// processing. Errors: kNotFound and kInvalidArgument with file, line and column: an unknown
/// driver, or halves with readings that the driver cannot fuse.
Status set_hybrid(const DeviceContext& context, const config::RobotGroup& group,
                  const config::SensorFile& file, const sim::RobotType& type,
                  sim::SensorSpec& sensor);

}  // namespace rave::runtime
