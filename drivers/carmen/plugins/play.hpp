// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "carmen/log.hpp"
#include "rave/base/result.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "recording/play_params.hpp"

namespace rave::carmen {

/// The parameters that all players of CARMEN logs have.
inline constexpr auto kLogParams = recording::join_params(
    std::array<ParamSpec, 1>{
        required(text_param("log", "",
                            "The log, plain or gzipped, relative to the folder of the robot "
                            "file.")),
    },
    recording::kPlayParams);

/// A log, read and ready to be played.
struct LogPlay {
  std::string path;  ///< As the parameter gives it.
  recording::PlayOptions options;
  Log log;
};

/// Reads what the parameters of a player ask for. Errors: those of load().
[[nodiscard]] Result<LogPlay> load_play(const HardwareSetup& setup, double range_max_m = 80);

/// The report of a stream as one JSON object, described in README.md of this driver.
[[nodiscard]] std::string report_json(const LogPlay& play, std::string_view stream,
                                      const recording::StreamReport& report);

}  // namespace rave::carmen
