// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/record/run_info.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/robot/hardware_sensor.hpp"

namespace rave::playback {

/// What the parameters of a player ask for.
struct Wish {
  std::string file;    ///< As given.
  std::string robot;   ///< Its name in the record.
  std::string sensor;  ///< Its name there; empty: the reported pose of the robot (poses only).
  record::PerceptPart part = record::PerceptPart::kResult;
  double start_s = 0;  ///< Time of the record that is run time 0.
  bool live = false;
  /// Sightings only: those of several steps belong together until the program decides.
  bool collect = false;
};
[[nodiscard]] Wish wish_of(const Params& params, ReadingKind kind);

/// One recorded reading on its way into a run. Times are of that run.
struct Sample {
  SimTime stamp;
  SimTime delivered;       ///< When the recorded run got it; not before `stamp`.
  std::size_t offset = 0;  ///< Bytes, into Timeline::records.
  std::uint32_t count = 0;
};

/// All that a player will publish, by stamp, which never steps back.
struct Timeline {
  std::vector<Sample> samples;
  std::vector<std::byte> records;
  std::uint32_t largest = 0;    ///< Records of one sample at most.
  std::uint64_t left_out = 0;   ///< Readings whose stamp stepped back.
  record::RecordedSensor info;  ///< Geometry of a range sensor.
};

/// Reads what a player of `kind` is to play. `folder` is where a relative file name starts. Errors:
/// those of reading a record (naming the file), a robot or sensor that is not in it (with the
/// nearest name), a sensor of another kind.
[[nodiscard]] Result<Timeline> load_timeline(const Wish& wish, const std::string& folder,
                                             ReadingKind kind);

/// The report of a player as one JSON object.
[[nodiscard]] std::string report_json(const Wish& wish, const Timeline& timeline);

}  // namespace rave::playback
