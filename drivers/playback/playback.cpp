// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <stop_token>
#include <thread>

#include "playback/timeline.hpp"
#include "rave/base/thread.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave::playback {
namespace {

constexpr std::array<const char*, 2> kClocks{"stepped", "live"};
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
      choice_param("clock", "stepped", kClocks,
                   "Whether samples follow simulation time or the wall clock."),
  };
}
constexpr auto kParams = params_with(required(text_param("sensor", "", kSensorDoc)));
constexpr auto kSightingParams = [] {
  std::array<ParamSpec, kParams.size() + 1> all{};
  std::copy(kParams.begin(), kParams.end(), all.begin());
  all.back() = bool_param("collect", true,
                          "Sightings of several steps stay together until the program decides, as "
                          "with a real camera; false: the newest reading counts.");
  return all;
}();
constexpr auto kPoseParams =
    params_with(text_param("sensor", "",
                           "The sensor of that robot whose readings are played; empty: the "
                           "reported pose of the robot, in the world frame."));

/// Plays the readings of one recorded sensor like its hardware: from its own thread, with the
/// recorded stamps. Each open() starts over with the same samples.
///
/// Belongs to the thread of the host; only play() runs in the player's thread, and reads data of
/// configure().
template <ReadingKind kKind>
class Player final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = kKind;

  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    const Source source = source_of(setup.parameters(), kKind);
    RAVE_TRY_ASSIGN(timeline_, load_timeline(source, setup.folder, kKind));
    report_ = report_json(source, timeline_);
    live_ = source.live;
    const auto& bearings = timeline_.info.bearings_rad;
    declaration.capacity = std::max(1U, timeline_.largest);
    if (kKind == ReadingKind::kRanges && !bearings.empty()) {
      declaration.capacity = static_cast<std::uint32_t>(bearings.size());
      declaration.bearings_rad = bearings.data();
      declaration.range_min_m = timeline_.info.range_min_m;
      declaration.range_max_m = timeline_.info.range_max_m;
      declaration.cone_rad = timeline_.info.cone_rad;
    }
    if (source.collect) {
      declaration.collect = 1;
      // Several readings stay together until the program decides, so there must be room for more
      // than one of them.
      declaration.capacity = std::max(64U, timeline_.largest);
    }
    declaration.clock = live_ ? DriverClock::kLive : DriverClock::kStepped;
    return {};
  }

  Status open(SampleSink& sink) override {
    if (thread_.joinable()) return fail(ErrorCode::kState, "opened twice; close it first");
    return start_thread(thread_, "the player",
                        [this, &sink](const std::stop_token& stop) { play(sink, stop); });
  }

  void close() override {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

  [[nodiscard]] std::string report() const override { return report_; }

 private:
  void play(SampleSink& sink, const std::stop_token& stop) const noexcept {
    for (const Sample& sample : timeline_.samples) {
      if (stop.stop_requested()) return;
      if (live_) {
        if (!sink.wait_until(sample.delivered)) return;
      } else {
        // Completes only the time before the stamp: publish() may wait for room while the host
        // waits for completeness.
        sink.complete_up_to({sample.stamp.ns - 1});
      }
      if (!sink.publish(sample.stamp, timeline_.records.data() + sample.offset, sample.count)) {
        return;
      }
    }
    // Nothing more comes, so a stepped run need not wait for this sensor.
    sink.complete_up_to({std::numeric_limits<std::int64_t>::max()});
  }

  Timeline timeline_;
  std::string report_ = "{}";
  bool live_ = false;
  std::jthread thread_;  // last member: it ends before the data it reads is destroyed
};

template <ReadingKind kKind>
void add_player(RegistrySink& registry, const char* name, const char* summary,
                std::span<const ParamSpec> params) {
  add_sensor<Player<kKind>>(
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
