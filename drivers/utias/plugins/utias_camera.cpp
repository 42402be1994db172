// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "rave/robot/plugin_entry.hpp"
#include "utias/plugins/stream.hpp"

namespace rave::utias {
namespace {

constexpr std::array<const char*, 2> kCodes{"barcode", "subject"};
constexpr auto kParams = recording::join_params(
    kPlaybackParams, std::array<ParamSpec, 1>{
                         choice_param("codes", "barcode", kCodes,
                                      "Interpretation of the number in the log; `subject` is a "
                                      "known mistake, for checks that must detect it."),
                     });

/// The code that the camera reports. With the wrong meaning, a number that is not a subject becomes
/// negative, so that it cannot match a barcode by chance.
int code_read(int number, CodeMeaning meaning, const Subjects& subjects) {
  if (meaning == CodeMeaning::kBarcode) return number;
  const int code = subjects.code_of_subject(number);
  return code >= 0 ? code : -1 - number;
}

/// The barcodes that the robot's camera saw; those of one image in one sample.
struct Camera {
  using Record = rave::Sighting;
  static constexpr ReadingKind kReading = ReadingKind::kSightings;
  static constexpr StreamKind kKind = StreamKind::kSightings;
  static constexpr std::uint32_t kCapacity = 64;
  // Sightings are events: those of several images accumulate until the program takes them, while of
  // poses only the newest counts.
  static constexpr std::uint32_t kCollect = 1;

  static CodeMeaning code_meaning(const Params& params) {
    return params.text("codes") == "subject" ? CodeMeaning::kSubject : CodeMeaning::kBarcode;
  }

  static recording::Timeline<Record> timeline(const Params& params, const Playback& playback) {
    recording::Timeline<Record> timeline;
    for (const Sighting& seen : playback.robot().sightings) {
      const SimTime stamp = playback.run_time(seen.t_ns);
      if (timeline.groups.empty() || timeline.groups.back().stamp != stamp) timeline.begin(stamp);
      timeline.add({.stamp_ns = stamp.ns,
                    .code = code_read(seen.code, code_meaning(params), playback.data.subjects),
                    .range_m = static_cast<float>(seen.range_m),
                    .bearing_rad = static_cast<float>(seen.bearing_rad)});
    }
    return timeline;
  }
};

}  // namespace
}  // namespace rave::utias

RAVE_PLUGIN("utias_camera") {
  rave::add_sensor<rave::utias::Player<rave::utias::Camera>>(
      registry, {.name = "utias_camera",
                 .summary = "Plays the barcode sightings of a recorded UTIAS robot.",
                 .params = rave::utias::kParams,
                 .clock = rave::DriverClock::kEither});
}
