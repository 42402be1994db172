// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "playback/timeline.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "recording/play_params.hpp"
#include "recording/player.hpp"

namespace rave::playback {
namespace {

constexpr std::array<const char*, 3> kParts{"result", "real", "virtual"};
constexpr const char* kSensorDoc = "The sensor of that robot whose readings are played.";

constexpr std::array<ParamSpec, 6> params_with(ParamSpec sensor) noexcept {
  return {
      required(text_param("file", "",
                          "The recording (run.mcap), relative to the folder of the robot file.")),
      required(text_param("robot", "", "Name of the robot in the recording.")),
      sensor,
      choice_param("part", "result", kParts,
                   "What is played of a hybrid sensor: what the program was given, or one half."),
      number_param("start_s", "s", 0, 0, 1e9, "Time in the recording at which the run starts."),
      choice_param("clock", "stepped", recording::kClocks,
                   "Whether samples follow simulation time or the wall clock."),
  };
}
constexpr auto kParams = params_with(required(text_param("sensor", "", kSensorDoc)));
constexpr auto kSightingParams = recording::join_params(
    kParams, std::array<ParamSpec, 1>{
                 bool_param("collect", true,
                            "Sightings of several steps stay together until the program decides, "
                            "as with a real camera; false: the newest reading counts."),
             });
constexpr auto kPoseParams =
    params_with(text_param("sensor", "",
                           "The sensor of that robot whose readings are played; empty: the "
                           "reported pose of the robot, in the world frame."));

/// The readings of one recorded sensor, as bytes of records.
template <ReadingKind kKind>
class Readings {
 public:
  using Record = std::byte;
  static constexpr ReadingKind kReading = kKind;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  Result<recording::Played<std::byte>> load(const HardwareSetup& setup) {
    source_ = source_of(setup.parameters(), kKind);
    RAVE_TRY_ASSIGN(Timeline timeline, load_timeline(source_, setup.folder, kKind));
    info_ = std::move(timeline.info);
    std::string report = report_json(source_, timeline);
    return recording::Played<std::byte>{std::move(timeline), std::move(report), source_.live};
  }

  void declare(HardwareDeclaration& declaration) const noexcept {
    const auto& bearings = info_.bearings_rad;
    if (kKind == ReadingKind::kRanges && !bearings.empty()) {
      declaration.capacity = static_cast<std::uint32_t>(bearings.size());
      declaration.bearings_rad = bearings.data();
      declaration.range_min_m = info_.range_min_m;
      declaration.range_max_m = info_.range_max_m;
      declaration.cone_rad = info_.cone_rad;
    }
    if (!source_.collect) return;
    declaration.collect = 1;
    // Several readings stay together until the program decides, so there must be room for more
    // than one of them.
    declaration.capacity = std::max(64U, declaration.capacity);
  }

 private:
  Source source_;
  record::RecordedSensor info_;
};

template <ReadingKind kKind>
void add_player(RegistrySink& registry, const char* name, const char* summary,
                std::span<const ParamSpec> params) {
  add_sensor<recording::Player<Readings<kKind>>>(
      registry,
      {.name = name, .summary = summary, .params = params, .clock = DriverClock::kEither});
}

}  // namespace
}  // namespace rave::playback

RAVE_PLUGIN(
    "playback_ranges playback_sightings playback_pose playback_odometry playback_neighbours "
    "playback_contact playback_velocity playback_values") {
  using namespace rave;
  using namespace rave::playback;
  add_player<ReadingKind::kRanges>(registry, "playback_ranges",
                                   "Plays the ranges of a sensor in a recording.", kParams);
  add_player<ReadingKind::kSightings>(registry, "playback_sightings",
                                      "Plays the barcode sightings of a sensor in a recording.",
                                      kSightingParams);
  add_player<ReadingKind::kPose>(
      registry, "playback_pose",
      "Plays the poses of a sensor in a recording, or the reported poses of a robot.", kPoseParams);
  add_player<ReadingKind::kOdometry>(registry, "playback_odometry",
                                     "Plays the odometry of a sensor in a recording.", kParams);
  add_player<ReadingKind::kNeighbours>(registry, "playback_neighbours",
                                       "Plays the neighbours that a sensor in a recording saw.",
                                       kParams);
  add_player<ReadingKind::kContact>(registry, "playback_contact",
                                    "Plays the contacts of a sensor in a recording.", kParams);
  add_player<ReadingKind::kVelocity>(registry, "playback_velocity",
                                     "Plays the velocities of a sensor in a recording.", kParams);
  add_player<ReadingKind::kValues>(registry, "playback_values",
                                   "Plays the values of a sensor in a recording.", kParams);
}
