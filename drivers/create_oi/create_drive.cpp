// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_drive.hpp"

#include <algorithm>

namespace rave::oi {
namespace {

/// Expiry of a stop that needs no repetition.
constexpr double kForGood_s = 1e6;

}  // namespace

Status CreateDrive::open(const DeviceSetup& setup) {
  device_ = static_cast<CreateDevice*>(setup.device);
  if (device_ == nullptr) return fail(ErrorCode::kState, "has no `device`");
  const Params params = setup.parameters();
  watchdog_s_ = params.number("watchdog_s");
  max_mmps_ = 1e3 * std::min(params.number("max_wheel_mps"), device_->geometry().max_wheel_mps);
  return {};
}

Status CreateDrive::write(const Command& command, SimTime /*now*/) {
  if (command.kind != CommandKind::kVelocity) {
    return fail(ErrorCode::kInvalidArgument, "expected velocities, found {}",
                to_string(command.kind));
  }
  // A command without values means stop.
  const double v_mps = command.count >= 1 ? command.value[0] : 0;
  const double w_radps = command.count >= 2 ? command.value[1] : 0;
  return device_->drive(wheel_speeds(v_mps, w_radps, device_->geometry().wheel_base_m, max_mmps_),
                        watchdog_s_);
}

void CreateDrive::close() {
  if (device_ != nullptr) (void)device_->drive({}, kForGood_s);
}

}  // namespace rave::oi
