// SPDX-License-Identifier: Apache-2.0
#include "shared_device.hpp"

#include <array>
#include <string_view>
#include <vector>

#include "device_tools.hpp"
#include "rave/base/names.hpp"

namespace rave::runtime {
namespace {

using plugin::Driver;

/// Names of the robot's devices with this driver; all devices if it is empty.
std::vector<std::string_view> devices_of(const sim::RobotType& type, std::string_view driver) {
  std::vector<std::string_view> names;
  for (const sim::DeviceSpec& device : type.devices) {
    if (driver.empty() || device.driver == driver) names.emplace_back(device.name);
  }
  return names;
}

/// A sensor casts the device to a class of its own plug-in.
Status check_same_plugin(const DeviceContext& context, const Driver& user,
                         const sim::DeviceSpec& device, const SourceLocation& where) {
  constexpr std::array kKinds = {DriverKind::kDevice};
  RAVE_TRY_ASSIGN(const Driver* const found, context.catalogue.find(kKinds, device.driver));
  // Two plug-ins may be built with different layouts of that class, and no stamp covers a class of
  // their own.
  if (found->file == user.file) return {};
  return fail_at(
      where, ErrorCode::kPlugin,
      "the drivers `{}` and `{}` must come from one plug-in, but they come from `{}` and `{}`",
      user.info.name, device.driver, user.file.string(), found->file.string());
}

}  // namespace

Result<std::optional<std::uint32_t>> shared_device(
    const DeviceContext& context, const Driver& user, const codec::Located<std::string>& driver,
    const std::optional<codec::Located<std::string>>& named, const sim::RobotType& type) {
  const DriverInfo& info = user.info;
  const std::string_view wanted = info.device;
  if (wanted.empty()) {
    if (!named) return std::nullopt;
    return fail_at(named->where, ErrorCode::kInvalidArgument,
                   "the driver `{}` does not use a device: expected no `device:`", info.name);
  }
  // The suggestion lists only devices of the right driver; a robot may have several lines.
  const auto fitting = devices_of(type, wanted);
  const std::string there =
      fitting.empty() ? "the robot has none" : "there is " + join_names(fitting);
  if (!named) {
    return fail_at(driver.where, ErrorCode::kInvalidArgument,
                   "the driver `{}` is part of a device: expected `device:` with the name of an "
                   "entry of `devices:` that has the driver `{}`; {}",
                   info.name, wanted, there);
  }
  for (std::uint32_t d = 0; d < type.devices.size(); ++d) {
    if (type.devices[d].name != named->value) continue;
    if (type.devices[d].driver == wanted) {
      RAVE_TRY(check_same_plugin(context, user, type.devices[d], named->where));
      return d;
    }
    return fail_at(named->where, ErrorCode::kInvalidArgument,
                   "the driver `{}` needs a device of the driver `{}`, but `{}` has `{}`; {}",
                   info.name, wanted, named->value, type.devices[d].driver, there);
  }
  return fail_at(named->where, ErrorCode::kNotFound, "there is no device `{}`{}", named->value,
                 suggestion(named->value, devices_of(type, "")));
}

}  // namespace rave::runtime
