// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <numbers>

#include "rave/robot/plugin_entry.hpp"
#include "utias/plugins/stream.hpp"

namespace rave::utias {
namespace {

constexpr auto kParams = recording::join_params(
    kPlaybackParams, std::array<ParamSpec, 2>{
                         number_param("position_sigma_m", "m", 0.001, 0, 10,
                                      "Standard deviation that each of x and y is said to have."),
                         number_param("heading_sigma_deg", "deg", 0.5, 0, 180,
                                      "Standard deviation that the heading is said to have."),
                     });

/// The poses of the motion capture, in its frame.
struct Mocap {
  using Record = PoseReading;
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static constexpr StreamKind kKind = StreamKind::kPoses;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  static CodeMeaning code_meaning(const Params&) { return CodeMeaning::kBarcode; }

  static recording::Timeline<PoseReading> timeline(const Params& params, const Playback& playback) {
    const double sigma_m = params.number("position_sigma_m");
    const double sigma_rad = params.number("heading_sigma_deg") * (std::numbers::pi / 180);
    return recording::state_timeline<PoseReading>(
        playback.robot().poses.samples(), playback.data.start_ns, playback.data.end_ns,
        [=](const PoseSample& sample) {
          return PoseReading{sample.pose.x, sample.pose.y, sample.pose.yaw, sigma_m * sigma_m,
                             sigma_rad * sigma_rad};
        });
  }
};

}  // namespace
}  // namespace rave::utias

RAVE_PLUGIN("utias_mocap") {
  rave::add_sensor<rave::utias::Player<rave::utias::Mocap>>(
      registry, {.name = "utias_mocap",
                 .summary = "Plays the captured poses of a recorded UTIAS robot.",
                 .params = rave::utias::kParams,
                 .clock = rave::DriverClock::kEither});
}
