// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace rave::utias {

/// The meaning of the number in a sighting row.
enum class CodeMeaning : std::uint8_t {
  kBarcode,  ///< The true meaning: a barcode, to be looked up in `Barcodes.dat`.
  kSubject,  ///< The claim of the log's header; wrong, and here to show that a check detects it.
};

/// Which logs of a robot to load; the others stay empty. They are read nevertheless if the folder
/// has no `stretch.txt` and the origin must be found.
struct StreamChoice {
  bool poses = true;
  bool odometry = true;
  bool sightings = true;
};

struct LoadOptions {
  /// The robots to load, by subject number.
  std::vector<int> robots = {1, 2, 3, 4, 5};
  StreamChoice streams;

  /// The window, seconds from the origin of the data set, both ends included. Default: the whole
  /// stretch in the folder; a wider window is refused.
  std::optional<double> start_s;
  std::optional<double> end_s;
  /// Margin of poses and odometry at both ends, seconds in [0, 1000]. The last row before it is
  /// kept too, for its value.
  double margin_s = 1.0;

  CodeMeaning code_meaning = CodeMeaning::kBarcode;
  /// Offset added to the stamps of sightings, seconds within +-1000; applied before the window.
  double clock_offset_s = 0;
  /// The offset for poses and odometry. A stretch made by tools/cut_utias.py has a margin of 1 s.
  double state_clock_offset_s = 0;

  /// Keep the complete lines of a truncated log.
  bool accept_cut = false;
};

}  // namespace rave::utias
