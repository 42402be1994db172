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

/// The parameters common to all players of CARMEN logs.
inline constexpr auto kLogParams = recording::join_params(
    std::array<ParamSpec, 1>{
        required(text_param("log", "",
                            "The log, plain or gzipped, relative to the folder of the robot "
                            "file.")),
    },
    recording::kPlayParams);

/// A log that is ready to be played.
struct LogPlay {
  std::string path;  ///< As in the parameter.
  recording::PlayOptions options;
  Log log;
};

/// Reads the log that the parameters of a player name. Errors: those of load().
[[nodiscard]] Result<LogPlay> load_play(const HardwareSetup& setup, double range_max_m = 80);

/// The report of a stream as one JSON object; the README.md of this driver describes it.
[[nodiscard]] std::string report_json(const LogPlay& play, std::string_view stream,
                                      const recording::StreamReport& report);

}  // namespace rave::carmen
