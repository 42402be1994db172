// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "create_oi/create_device.hpp"
#include "rave/robot/actuator.hpp"

namespace rave::oi {

inline constexpr std::array<ParamSpec, 3> kDriveParams{
    number_param("watchdog_s", "s", 0.25, 0.02, 10,
                 "Time without a command after which the wheels stop."),
    number_param("device_watchdog_s", "s", 0, 0, 60,
                 "Timeout of an adapter between host and robot that stops the wheels by itself; 0: "
                 "there is none."),
    number_param("max_wheel_mps", "m/s", 0.5, 0.01, 0.5,
                 "Largest speed of a wheel; never more than the device's."),
};

/// Drives the wheels of a device: converts velocities to Drive Direct commands.
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
