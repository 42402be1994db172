// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "utias/text_log.hpp"

namespace rave::utias {

/// What the number in a sighting row means.
enum class CodeMeaning : std::uint8_t {
  kBarcode,  ///< What it is: look the subject up in `Barcodes.dat`.
  kSubject,  ///< What the log's header claims; wrong, and here to show that a check notices.
};

/// Which logs of a robot are wanted; the others stay empty in its RobotLog and are not read, unless
/// the folder has no `stretch.txt` and the origin must be found.
struct StreamChoice {
  bool poses = true;
  bool odometry = true;
  bool sightings = true;
};

struct LoadOptions {
  /// The robots to load, by subject number.
  std::vector<int> robots = {1, 2, 3, 4, 5};
  StreamChoice streams;

  /// The window, seconds from the origin of the data set, both ends included. By default the
  /// stretch that the folder holds; a wider one than that is refused.
  std::optional<double> start_s;
  std::optional<double> end_s;
  /// How much more is kept of poses and odometry at both ends, seconds in [0, 1000]. The last row
  /// before that is kept too, to be held.
  double margin_s = 1.0;

  CodeMeaning code_meaning = CodeMeaning::kBarcode;
  /// Added to the stamps of sightings only, seconds within +-1000; the window applies afterwards.
  double clock_offset_s = 0;
  /// The same for poses and odometry. A stretch cut by tools/cut_utias.py holds a margin of 1 s.
  double state_clock_offset_s = 0;

  ParsePolicy parse;
  /// Refuse files whose SHA-256 differs from `stretch.txt` (a log accepted as cut is exempt).
  bool require_unchanged = true;
  /// Largest unpacked size of one file.
  std::size_t max_unpacked_bytes = std::size_t{256} << 20;

  /// Longer stretches without rows are listed in the reports, seconds.
  double pose_gap_limit_s = 0.15;
  double odometry_gap_limit_s = 0.2;
  double sighting_gap_limit_s = 5.0;
};

}  // namespace rave::utias
