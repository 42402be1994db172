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

inline constexpr std::array<const char*, 2> kSides{"front", "rear"};

/// The parameters common to all players of CARMEN logs.
inline constexpr auto kLogParams = recording::join_params(
    std::array<ParamSpec, 3>{
        required(text_param("log", "",
                            "The log, plain or gzipped, relative to the folder of the robot "
                            "file.")),
        choice_param("laser", "front", kSides,
                     "front: the scans of FLASER, ROBOTLASER1 or RAWLASER1 rows; rear: those of "
                     "RLASER, ROBOTLASER2 or RAWLASER2 rows."),
        number_param("rate_hz", "Hz", 0, 0, 1000,
                     "Number of scans in a second, for a log whose rows have no times of their "
                     "own; 0: the stamps of the log."),
    },
    recording::kPlayParams);

/// A log that is ready to be played.
struct LogPlay {
  std::string path;  ///< As in the parameter.
  recording::PlayOptions options;
  Log log;
};

/// What carmen_laser asks of a log; the other players do not look at ranges.
struct RangeLimits {
  double range_max_m = 80;
  double no_return_m = 0;  ///< As of LoadOptions.
};

/// Reads the log that the parameters of a player name. Errors: those of load().
[[nodiscard]] Result<LogPlay> load_play(const HardwareSetup& setup, const RangeLimits& limits = {});

/// The report of a stream as one JSON object; the README.md of this driver describes it.
[[nodiscard]] std::string report_json(const LogPlay& play, std::string_view stream,
                                      const recording::StreamReport& report);

}  // namespace rave::carmen
