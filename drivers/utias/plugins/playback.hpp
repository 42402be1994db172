// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "utias/dataset.hpp"
#include "utias/stream_report.hpp"

namespace rave::utias {

inline constexpr std::array<const char*, 2> kClocks{"stepped", "live"};

/// The parameters that all three players have.
inline constexpr std::array<ParamSpec, 7> kPlaybackParams{
    required(text_param("folder", "", "Folder of the logs, relative to that of the robot file.")),
    required(integer_param("robot", 1, 1, 5, "Which of the recorded robots to play.")),
    choice_param("clock", "stepped", kClocks,
                 "Whether samples come by simulation time or by the clock on the wall."),
    number_param("start_s", "s", -1, -1, 1e6,
                 "Time of the recording that is run time 0; -1: where the logs start."),
    number_param("end_s", "s", -1, -1, 1e6,
                 "Time of the recording after which nothing comes; -1: where the logs end."),
    number_param("clock_offset_s", "s", 0, -1000, 1000,
                 "Added to all stamps: a clock that is off."),
    bool_param("accept_cut", false, "Use the whole lines of a log that ends in the middle of one."),
};

/// The common parameters and those of one player.
template <std::size_t kCount>
constexpr std::array<ParamSpec, kPlaybackParams.size() + kCount> with_playback_params(
    const std::array<ParamSpec, kCount>& own) noexcept {
  std::array<ParamSpec, kPlaybackParams.size() + kCount> all{};
  std::size_t count = 0;
  for (const ParamSpec& spec : kPlaybackParams) all[count++] = spec;
  for (const ParamSpec& spec : own) all[count++] = spec;
  return all;
}

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
