// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "recording/play_params.hpp"
#include "utias/dataset.hpp"
#include "utias/stream_report.hpp"

namespace rave::utias {

/// The parameters common to the three players.
inline constexpr auto kPlaybackParams = recording::join_params(
    std::array<ParamSpec, 2>{
        required(
            text_param("folder", "", "Folder of the logs, relative to that of the robot file.")),
        required(integer_param("robot", 1, 1, 5, "Number of the recorded robot to play.")),
    },
    recording::kPlayParams);

/// One stream of one robot, ready to be played. A plain value.
struct Playback {
  /// As in the parameter.
  std::string folder;
  double clock_offset_s = 0;
  bool live = false;
  StreamKind kind = StreamKind::kPoses;
  /// Contains this robot and this stream only. Stamps include the clock offset.
  Dataset data;

  [[nodiscard]] const RobotLog& robot() const noexcept { return data.robots.front(); }
  [[nodiscard]] const StreamReport& report() const noexcept;
  /// Time 0 of the run is the start of the window.
  [[nodiscard]] SimTime run_time(std::int64_t t_ns) const noexcept {
    return {t_ns - data.start_ns};
  }
};

/// Loads the log of `kind` that the parameters of a player name. `code_meaning` applies to
/// sightings only. Errors: those of load().
[[nodiscard]] Result<Playback> load_playback(const HardwareSetup& setup, StreamKind kind,
                                             CodeMeaning code_meaning);

}  // namespace rave::utias
