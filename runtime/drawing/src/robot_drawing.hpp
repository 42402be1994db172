// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/assemble/build.hpp"
#include "rave/base/result.hpp"
#include "rave/config/any_file.hpp"
#include "rave/report/picture.hpp"

namespace rave::drawing {

/// One robot with its sensors: mounting points with their directions and names, fields of view cut
/// to a length that leaves the body to be seen, and in the caption what each sensor is.
[[nodiscard]] Result<report::Picture> draw_one_robot(const config::AnyFile& input,
                                                     runtime::BuiltScenario built);

/// Leaves of a type what can be made without a device, program or wait: its virtual sensors, and of
/// hybrid ones the virtual half. A real robot would wait for its pose source.
void keep_virtual_sensors(sim::RobotType& type);

}  // namespace rave::drawing
