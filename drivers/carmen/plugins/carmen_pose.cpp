// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>

#include "carmen/plugins/play.hpp"
#include "pose_doubt/pose_doubt.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "recording/player.hpp"

namespace rave::carmen {
namespace {

constexpr auto kParams = recording::join_params(
    kLogParams, std::array<ParamSpec, 2>{
                    pose_doubt::position_sigma(0.03, recording::kPositionSigmaDoc),
                    pose_doubt::heading_sigma(0.3, recording::kHeadingSigmaDoc),
                });

/// The laser pose at each scan, in the frame of the log.
struct Poses {
  using Record = PoseReading;
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  static Result<recording::Played<PoseReading>> load(const HardwareSetup& setup) {
    RAVE_TRY_ASSIGN(const LogPlay play, load_play(setup));
    if (!play.log.poses) {
      return fail(ErrorCode::kInvalidArgument,
                  "`{}`: {} rows have no pose, and there is no ODOM row to take it from", play.path,
                  play.log.message->name);
    }
    const pose_doubt::Doubt doubt = pose_doubt::read_doubt(setup.parameters());
    const auto convert = [=](const Scan& scan) {
      return PoseReading{scan.X_WL.x, scan.X_WL.y, scan.X_WL.yaw, doubt.variance_xy_m2,
                         doubt.variance_yaw_rad2};
    };
    return recording::Played<PoseReading>{
        recording::state_timeline<PoseReading>(std::span(play.log.scans), play.log.start_ns,
                                               play.log.end_ns, convert),
        report_json(play, "poses", play.log.scan_report), play.options.live};
  }
  static void declare(HardwareDeclaration& /*declaration*/) noexcept {}
};

}  // namespace
}  // namespace rave::carmen

RAVE_PLUGIN("carmen_pose") {
  rave::add_sensor<rave::recording::Player<rave::carmen::Poses>>(
      registry, {.name = "carmen_pose",
                 .summary = "Plays the laser poses of a corrected CARMEN log.",
                 .params = rave::carmen::kParams,
                 .clock = rave::DriverClock::kEither});
}
