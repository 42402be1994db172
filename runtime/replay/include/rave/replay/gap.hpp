// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::runtime {

/// What a recorded robot is compared with.
struct GapOptions {
  std::string robot;           ///< Its name in the record; empty: the only one.
  std::filesystem::path twin;  ///< Robot file with a simulated actuator; empty: the robot's own.
  std::string commands;        ///< A velocity sensor that tells the commands; empty: those that
                               ///< reached the actuator.
  bool truth = false;          ///< Compare with the true pose of a simulated robot.
  double window_s = 10;        ///< Of the windows that start anew; above 0.
};

/// How far robot and twin are from each other.
struct GapAt {
  double after_s = 0;  ///< Since the twin was put where the robot was.
  double metres = 0;
  double degrees = 0;  ///< Of heading, 0 to 180.
};

/// Middle and near-worst of windows; nothing if there are none. Percentiles by nearest rank.
struct GapWindows {
  double window_s = 0;
  std::size_t count = 0;
  double median_m = 0;
  double p95_m = 0;
  double median_deg = 0;
  double p95_deg = 0;
};

struct GapReport {
  std::string robot;
  std::string twin;      ///< Driver of the simulated actuator, and the file it came from.
  std::string commands;  ///< Where the commands came from.
  std::string pose;      ///< Where the robot's pose came from.
  double start_s = 0;    ///< Of the record: the first pose.
  double duration_s = 0;
  double driven_m = 0;       ///< By the twin.
  std::vector<GapAt> after;  ///< 10, 30 and 60 s, as far as they fit, and the end.
  GapAt largest;             ///< Greatest distance, with when; `degrees` is that moment's.
  double largest_deg = 0;    ///< Greatest difference of heading, whenever.
  double rms_m = 0;
  double rms_deg = 0;
  GapWindows windows;
  std::size_t steps = 0;  ///< Of the drive; the robot's pose is known in those of `points`.
  struct Point {
    SimTime time;
    Pose2 X_WR;  ///< Of the robot.
    Pose2 X_WT;  ///< Of the twin.
  };
  std::vector<Point> points;  ///< Each step in which the robot's pose is known.
};

/// Puts the simulated twin of a recorded robot where the robot was first known to be, gives it the
/// recorded commands at their times and compares where the two are. The twin drives in an empty
/// world with the step of the record. Errors: kNotFound (robot, sensor), kInvalidArgument (no twin,
/// no commands, fewer than two poses), those of reading the files.
[[nodiscard]] Result<GapReport> measure_gap(const std::filesystem::path& record,
                                            plugin::Catalogue& catalogue,
                                            const GapOptions& options);

/// The report as one JSON object; lengths in metres, times in seconds, angles in degrees.
[[nodiscard]] std::string gap_json(const GapReport& report);

/// Draws both tracks to `folder/STEM.svg` and `folder/STEM.png`.
[[nodiscard]] Status draw_gap(const GapReport& report, const std::filesystem::path& folder,
                              const std::string& stem);

}  // namespace rave::runtime
