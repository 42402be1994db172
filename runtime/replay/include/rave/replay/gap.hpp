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

/// Options for measure_gap().
struct GapOptions {
  std::string robot;           ///< Name of the robot in the recording; empty: the only one.
  std::filesystem::path twin;  ///< Robot file with a simulated actuator; empty: that of the robot.
  std::string commands;        ///< Velocity sensor that provides the commands; empty: the recorded
                               ///< commands to the actuator.
  bool truth = false;          ///< Compare with the true pose of a simulated robot.
  /// Length of the windows; the twin is placed anew at the start of each; above 0.
  double window_s = 10;
};

/// The difference between robot and twin at one time.
struct GapAt {
  double after_s = 0;  ///< Time since the twin was placed at the robot's pose.
  double metres = 0;
  double degrees = 0;  ///< Difference of heading, 0 to 180.
};

/// Median and 95th percentile of the differences at the end of windows, by nearest rank; empty
/// without windows.
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
  std::string commands;  ///< Source of the commands.
  std::string pose;      ///< Source of the robot's poses.
  double start_s = 0;    ///< Time of the first pose in the recording.
  double duration_s = 0;
  double driven_m = 0;       ///< Distance driven by the twin.
  std::vector<GapAt> after;  ///< At 10, 30 and 60 s, if the drive is long enough, and at the end.
  GapAt largest;  ///< Largest distance, and its time; `degrees` is the difference of heading at
                  ///< that time.
  double largest_deg = 0;  ///< Largest difference of heading at any time.
  double rms_m = 0;
  double rms_deg = 0;
  GapWindows windows;
  /// Number of steps of the drive; `points` has those with a known pose of the robot.
  std::size_t steps = 0;
  struct Point {
    SimTime time;
    Pose2 X_WR;  ///< Pose of the robot.
    Pose2 X_WT;  ///< Pose of the twin.
  };
  std::vector<Point> points;  ///< One per step with a known pose of the robot.
};

/// Measures the difference between a recorded robot and its simulation. The simulated twin starts
/// at the first known pose of the robot and receives the recorded commands at their times, in an
/// empty world with the step of the recording. Errors: kNotFound (robot, sensor), kInvalidArgument
/// (no twin, no commands, fewer than two poses), those of reading the files.
[[nodiscard]] Result<GapReport> measure_gap(const std::filesystem::path& record,
                                            plugin::Catalogue& catalogue,
                                            const GapOptions& options);

/// The report as one JSON object; lengths in metres, times in seconds, angles in degrees.
[[nodiscard]] std::string gap_json(const GapReport& report);

/// Draws both tracks to `folder/STEM.svg` and `folder/STEM.png`.
[[nodiscard]] Status draw_gap(const GapReport& report, const std::filesystem::path& folder,
                              const std::string& stem);

}  // namespace rave::runtime
