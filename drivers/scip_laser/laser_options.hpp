// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "rave/line/address.hpp"
#include "rave/line/timing.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "scip_laser/scip_parameters.hpp"
#include "scip_laser/scip_scan.hpp"

namespace rave::scip {

inline constexpr std::array<const char*, 2> kModes{"continuous", "polled"};
inline constexpr std::array<const char*, 2> kEncodings{"three", "two"};

inline constexpr std::array<ParamSpec, 11> kLaserParams{
    text_param("device", "", "Serial device, such as /dev/ttyACM0; or give `address`."),
    integer_param("baud", 115200, 1200, 1000000,
                  "Bit rate of a serial line after power-on; ignored on USB."),
    line::kAddressParam,
    choice_param("mode", "continuous", kModes,
                 "Whether the device sends continuously (MD, MS) or on request (GD, GS)."),
    choice_param("characters", "three", kEncodings,
                 "Characters per range: two are faster, but limited to 4.094 m."),
    integer_param("first_step", -1, -1, 9999, "First step to read; -1: the device's first."),
    integer_param("last_step", -1, -1, 9999, "Last step to read; -1: the device's last."),
    integer_param("skip_scans", 0, 0, 9,
                  "Number of scans to skip between two, in continuous mode."),
    line::latency_param("Smallest delay from the stamp of a scan to its first byte."),
    line::start_timeout_param("Time that the start of a run waits for the device."),
    line::lost_after_param(2, "Time after which a disconnected device is reported as lost."),
};

/// The parameters, read and checked.
struct LaserOptions {
  line::Address address;
  bool continuous = true;
  std::int32_t characters = 3;
  std::int32_t first_step = -1;
  std::int32_t last_step = -1;
  std::int32_t skip_scans = 0;
  line::Timing timing;
};

/// Errors: those of line::read_address.
[[nodiscard]] Result<LaserOptions> read_options(const Params& params);

/// The request for a device. Error (kInvalidArgument): steps that it does not have.
[[nodiscard]] Result<ScanRequest> request_for(const LaserOptions& options,
                                              const Parameters& device);

}  // namespace rave::scip
