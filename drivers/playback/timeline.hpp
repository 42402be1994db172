// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/record/run_info.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "recording/timeline.hpp"

namespace rave::playback {

/// The parameters of a player.
struct Source {
  std::string file;   ///< As in the parameter.
  std::string robot;  ///< Name of the robot in the recording.
  /// Name of the sensor there; empty: the reported pose of the robot (poses only).
  std::string sensor;
  record::PerceptPart part = record::PerceptPart::kResult;
  double start_s = 0;  ///< Time in the recording that becomes time 0 of the run.
  bool live = false;
  /// Sightings only: collect those of several steps until the program decides.
  bool collect = false;
};
[[nodiscard]] Source source_of(const Params& params, ReadingKind kind);

/// All samples of a player, ordered by stamp. Times are those of the new run.
struct Timeline : recording::Timeline<std::byte> {
  std::uint64_t left_out = 0;   ///< Readings omitted because their stamps decreased.
  record::RecordedSensor info;  ///< Geometry of a range sensor.
};

/// Loads the samples of a player of `kind`. `folder` is the base of a relative file name. Errors:
/// those of reading a recording (naming the file), an unknown robot or sensor (with the nearest
/// name), a sensor of another kind.
[[nodiscard]] Result<Timeline> load_timeline(const Source& source, const std::string& folder,
                                             ReadingKind kind);

/// The report of a player as one JSON object.
[[nodiscard]] std::string report_json(const Source& source, const Timeline& timeline);

}  // namespace rave::playback
