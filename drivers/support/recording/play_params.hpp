// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "rave/robot/hardware_sensor.hpp"

namespace rave::recording {

inline constexpr std::array<const char*, 2> kClocks{"stepped", "live"};

/// The parameters common to all players of recordings.
inline constexpr std::array<ParamSpec, 5> kPlayParams{
    choice_param("clock", "stepped", kClocks,
                 "Whether samples follow simulation time or the wall clock."),
    number_param("start_s", "s", -1, -1, 1e6,
                 "Time in the recording at which the run starts; -1: start of the logs."),
    number_param("end_s", "s", -1, -1, 1e6,
                 "Time in the recording at which it ends; -1: end of the logs."),
    number_param("clock_offset_s", "s", 0, -1000, 1000, "Added to all stamps, to correct a clock."),
    bool_param("accept_cut", false, "Accept a truncated log and use its complete lines."),
};

// Descriptions of the parameters of pose_doubt, for recordings without uncertainty.
inline constexpr const char* kPositionSigmaDoc = "Stated standard deviation of x and of y.";
inline constexpr const char* kHeadingSigmaDoc = "Stated standard deviation of the heading.";

/// Concatenates two lists of parameters.
template <std::size_t kFirst, std::size_t kSecond>
constexpr std::array<ParamSpec, kFirst + kSecond> join_params(
    const std::array<ParamSpec, kFirst>& first,
    const std::array<ParamSpec, kSecond>& second) noexcept {
  std::array<ParamSpec, kFirst + kSecond> all{};
  std::size_t count = 0;
  for (const ParamSpec& spec : first) all[count++] = spec;
  for (const ParamSpec& spec : second) all[count++] = spec;
  return all;
}

/// The values of kPlayParams.
struct PlayOptions {
  bool live = false;
  std::optional<double> start_s;
  std::optional<double> end_s;
  double clock_offset_s = 0;
  bool accept_cut = false;
};

[[nodiscard]] inline PlayOptions play_options(const Params& params) {
  // A parameter always has a value, so a negative one means "not given".
  const auto given = [](double seconds) {
    return seconds < 0 ? std::nullopt : std::optional<double>(seconds);
  };
  return {params.text("clock") == "live", given(params.number("start_s")),
          given(params.number("end_s")), params.number("clock_offset_s"),
          params.flag("accept_cut")};
}

}  // namespace rave::recording
