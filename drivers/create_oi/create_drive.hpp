// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "create_oi/create_device.hpp"
#include "rave/robot/actuator.hpp"

namespace rave::oi {

inline constexpr std::array<ParamSpec, 3> kDriveParams{
    number_param("watchdog_s", "s", 0.25, 0.02, 10,
                 "The wheels stop when no command came for so long."),
    number_param("device_watchdog_s", "s", 0, 0, 60,
                 "What stands between host and robot stops the wheels when it is told nothing for "
                 "so long; 0: nothing does."),
    number_param("max_wheel_mps", "m/s", 0.5, 0.01, 0.5,
                 "Largest speed of a wheel; never more than the device's."),
};

/// Drives the wheels of a device: velocity in, Drive Direct out.
class CreateDrive final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status open(const DeviceSetup& setup) override;
  Status write(const Command& command, SimTime now) override;
  void close() override;

 private:
  CreateDevice* device_ = nullptr;
  double watchdog_s_ = 0;
  double max_mmps_ = 0;
};

}  // namespace rave::oi
