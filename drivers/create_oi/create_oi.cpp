// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_drive.hpp"
#include "create_oi/create_sensors.hpp"
#include "rave/robot/plugin_entry.hpp"

RAVE_PLUGIN("create_oi create_odometry create_bumper create_cliff create_battery create_drive") {
  using namespace rave::oi;
  constexpr auto kLive = rave::DriverClock::kLive;
  constexpr auto kPeriodic = rave::SampleTiming::kPeriodic;
  rave::add_device<CreateDevice>(
      registry,
      {.name = "create_oi",
       .summary = "A robot with iRobot's Open Interface (Create 2, Roomba) on a serial line.",
       .params = kDeviceParams,
       .clock = kLive});
  rave::add_sensor<CreateOdometry>(
      registry, {.name = "create_odometry",
                 .summary = "Pose and velocity from the wheel encoders of a Create.",
                 .params = kOdometryParams,
                 .clock = kLive,
                 .device = "create_oi",
                 .timing = kPeriodic});
  rave::add_sensor<CreateBumper>(
      registry, {.name = "create_bumper",
                 .summary = "Whether the bumper of a Create is pressed: left, right or in front.",
                 .clock = kLive,
                 .device = "create_oi",
                 .timing = kPeriodic});
  rave::add_sensor<CreateCliff>(
      registry, {.name = "create_cliff",
                 .summary = "The four cliff sensors and the two wheel drops of a Create, each 0 or "
                            "1.",
                 .clock = kLive,
                 .device = "create_oi",
                 .timing = kPeriodic});
  rave::add_sensor<CreateBattery>(
      registry, {.name = "create_battery",
                 .summary = "Charge, voltage, current and temperature of the battery of a Create.",
                 .params = kBatteryParams,
                 .clock = kLive,
                 .device = "create_oi",
                 .timing = kPeriodic});
  rave::add_actuator<CreateDrive>(registry,
                                  {.name = "create_drive",
                                   .summary = "Drives the wheels of a Create by body velocity.",
                                   .params = kDriveParams,
                                   .clock = kLive,
                                   .device = "create_oi"});
}
