// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "pose_doubt/pose_doubt.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "utias/plugins/stream.hpp"

namespace rave::utias {
namespace {

constexpr auto kParams = recording::join_params(
    kPlaybackParams, std::array<ParamSpec, 2>{
                         pose_doubt::position_sigma(0.001, recording::kPositionSigmaDoc),
                         pose_doubt::heading_sigma(0.5, recording::kHeadingSigmaDoc),
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
    const pose_doubt::Doubt doubt = pose_doubt::read_doubt(params);
    return recording::state_timeline<PoseReading>(
        playback.robot().poses.samples(), playback.data.start_ns, playback.data.end_ns,
        [=](const PoseSample& sample) {
          return PoseReading{sample.pose.x, sample.pose.y, sample.pose.yaw, doubt.variance_xy_m2,
                             doubt.variance_yaw_rad2};
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
