// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "create_oi/oi_code.hpp"
#include "rave/line/address.hpp"
#include "rave/line/timing.hpp"
#include "rave/plugin/params.hpp"

namespace rave::oi {

inline constexpr std::array<const char*, 2> kDriveModes{"safe", "full"};

inline constexpr std::array<ParamSpec, 12> kDeviceParams{
    text_param("device", "", "Serial device, such as /dev/ttyUSB0; or give `address`."),
    integer_param("baud", 115200, 1200, 115200, "Bit rate of a serial line."),
    line::kAddressParam,
    choice_param("mode", "safe", kDriveModes,
                 "`safe`: the robot itself stops at cliffs and when it is lifted; `full`: it never "
                 "does."),
    number_param("wheel_base_m", "m", 0.235, 0.05, 1,
                 "Distance between the points where the wheels meet the floor."),
    number_param("wheel_diameter_m", "m", 0.072, 0.01, 1, "Diameter of a wheel."),
    number_param("counts_per_turn", "", 508.8, 1, 100000, "Encoder counts per turn of a wheel."),
    number_param("max_wheel_mps", "m/s", 0.5, 0.01, 0.5, "Largest speed of a wheel."),
    number_param("refresh_s", "s", 0.05, 0.015, 1,
                 "Time between repetitions of the drive command, which keep a watchdog on the "
                 "robot satisfied."),
    line::latency_param("Smallest delay from the measurement to the first byte of its frame."),
    line::start_timeout_param("Time that the start of a run waits for the robot."),
    line::lost_after_param(1, "Time after which a disconnected robot is reported as lost."),
};

/// Dimensions of the body for driving and odometry.
struct Geometry {
  double wheel_base_m = 0;
  double counts_per_m = 0;
  double max_wheel_mps = 0;
};

/// The parameters of the device, read and checked.
struct DeviceOptions {
  line::Address address;
  Mode mode = Mode::kSafe;
  Geometry geometry;
  double refresh_s = 0;
  line::Timing timing;
};

/// Errors: those of line::read_address.
[[nodiscard]] Result<DeviceOptions> read_options(const Params& params);

}  // namespace rave::oi
