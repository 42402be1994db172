// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rave/base/result.hpp"
#include "utias/load_options.hpp"
#include "utias/recording_names.hpp"
#include "utias/samples.hpp"
#include "utias/stream_report.hpp"
#include "utias/subjects.hpp"

namespace rave::utias {

/// The recording of one robot. All times are nanoseconds from the common origin of the data set.
struct RobotLog {
  int subject = 0;
  /// With margin; after the end of the recording the last pose holds.
  PoseTrack poses;
  /// Commanded velocities in order of time, with margin; each holds until the next.
  std::vector<OdometrySample> odometry;
  /// Within the window, in order of time; those of one image have one stamp.
  std::vector<Sighting> sightings;
  StreamReport pose_report;
  StreamReport odometry_report;
  StreamReport sighting_report;
};

/// A part of a UTIAS data set in memory. A plain value.
struct Dataset {
  /// Absolute stamp (Unix time) of time 0: the earliest row of any robot's logs.
  std::int64_t origin_ns = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  /// In the order of LoadOptions::robots.
  std::vector<RobotLog> robots;
  Subjects subjects;

  /// The recording of a robot by its subject number, or null.
  [[nodiscard]] const RobotLog* robot(int subject) const noexcept;
};

/// Reads a folder of logs: `Barcodes.dat`, `Landmark_Groundtruth.dat` and three files per robot,
/// each plain or gzipped (`.gz`), with or without the `stretch.txt` of tools/cut_utias.py. Without
/// it the origin is the earliest stamp of all robots in the folder. Errors: kNotFound (folder,
/// file, robot), kInvalidArgument (options), kParse (a malformed log or table, with
/// file:line:column), kIo.
[[nodiscard]] Result<Dataset> load(const std::filesystem::path& folder,
                                   const LoadOptions& options = {});

}  // namespace rave::utias
