// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// The device of `type` that `device:` names, checked against what the driver asks for; nothing if
/// it asks for none. Errors, with file, line and column: kNotFound, kInvalidArgument (of another
/// driver, missing, or not wanted), kPlugin (the two come from different plug-ins).
Result<std::optional<std::uint32_t>> shared_device(
    const DeviceContext& context, const plugin::Driver& user,
    const config::Located<std::string>& driver,
    const std::optional<config::Located<std::string>>& named, const sim::RobotType& type);

}  // namespace rave::runtime
