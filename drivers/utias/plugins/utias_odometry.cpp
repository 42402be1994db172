// SPDX-License-Identifier: Apache-2.0
#include <span>

#include "rave/robot/plugin_entry.hpp"
#include "utias/plugins/stream.hpp"

namespace rave::utias {
namespace {

/// The commanded velocities, which the data set calls odometry.
struct Commands {
  using Record = VelocityReading;
  static constexpr ReadingKind kReading = ReadingKind::kVelocity;
  static constexpr StreamKind kKind = StreamKind::kOdometry;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  static CodeMeaning code_meaning(const Params&) { return CodeMeaning::kBarcode; }

  static recording::Timeline<VelocityReading> timeline(const Params&, const Playback& playback) {
    return recording::state_timeline<VelocityReading>(
        std::span(playback.robot().odometry), playback.data.start_ns, playback.data.end_ns,
        [](const OdometrySample& sample) {
          return VelocityReading{sample.v_mps, sample.w_radps};
        });
  }
};

}  // namespace
}  // namespace rave::utias

RAVE_PLUGIN("utias_odometry") {
  rave::add_sensor<rave::utias::Player<rave::utias::Commands>>(
      registry, {.name = "utias_odometry",
                 .summary = "Plays the commanded velocities of a recorded UTIAS robot.",
                 .params = rave::utias::kPlaybackParams,
                 .clock = rave::DriverClock::kEither});
}
