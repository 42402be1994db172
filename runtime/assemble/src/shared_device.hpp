// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rave/assemble/devices.hpp"

namespace rave::runtime {

/// The device of `type` that `device:` names, checked against the needs of the driver; empty if it
/// needs none. Errors, with file, line and column: kNotFound, kInvalidArgument (another driver,
/// missing, or not needed), kPlugin (the two come from different plug-ins).
Result<std::optional<std::uint32_t>> shared_device(
    const DeviceContext& context, const plugin::Driver& user,
    const codec::Located<std::string>& driver,
    const std::optional<codec::Located<std::string>>& named, const sim::RobotType& type);

}  // namespace rave::runtime
