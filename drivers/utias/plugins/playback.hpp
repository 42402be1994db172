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

/// The parameters that all three players have.
inline constexpr auto kPlaybackParams = recording::join_params(
    std::array<ParamSpec, 2>{
        required(
            text_param("folder", "", "Folder of the logs, relative to that of the robot file.")),
        required(integer_param("robot", 1, 1, 5, "Number of the recorded robot to play.")),
    },
    recording::kPlayParams);

/// One stream of one robot, read and ready to be played. A plain value.
struct Playback {
  /// As the parameter gives it.
  std::string folder;
  double clock_offset_s = 0;
  bool live = false;
  StreamKind kind = StreamKind::kPoses;
  /// Holds the one robot, and of it the one stream. Its stamps include the offset of the clock.
  Dataset data;

  [[nodiscard]] const RobotLog& robot() const noexcept { return data.robots.front(); }
  [[nodiscard]] const StreamReport& report() const noexcept;
  /// The run starts where the window does.
  [[nodiscard]] SimTime run_time(std::int64_t t_ns) const noexcept {
    return {t_ns - data.start_ns};
  }
};

/// Reads what the parameters of a player ask for, the log of `kind` and no other.
/// `code_meaning` matters for sightings only. Errors: those of load().
[[nodiscard]] Result<Playback> load_playback(const HardwareSetup& setup, StreamKind kind,
                                             CodeMeaning code_meaning);

}  // namespace rave::utias
