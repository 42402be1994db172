// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>

#include "carmen/plugins/play.hpp"
#include "rave/base/time.hpp"
#include "rave/math/trigonometry.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "recording/player.hpp"

namespace rave::carmen {
namespace {

constexpr std::array<const char*, 2> kVelocities{"recorded", "from_poses"};
constexpr auto kParams = recording::join_params(
    kLogParams,
    std::array<ParamSpec, 1>{
        choice_param(
            "velocity", "recorded", kVelocities,
            "recorded: the velocities of the log; from_poses: the slope of the poses of the "
            "scans within 0.4 s, for corrected logs, which have no velocities."),
    });

/// Sets the body's velocity to the slope of the track; 0 if there are too few scans.
void differentiate(OdometryReading& reading, const recording::PoseTrack& track, std::int64_t t_ns) {
  const auto velocity = track.velocity(t_ns, from_seconds(0.4).ns);
  const SinCos heading = sincos(reading.yaw_rad);
  // The component of the velocity along the heading; a wheeled robot has no other, so the rest is
  // noise of the poses.
  reading.v_mps =
      velocity ? velocity->v_WR_W.x * heading.cos + velocity->v_WR_W.y * heading.sin : 0;
  reading.w_radps = velocity ? velocity->wz : 0;
}

/// The ODOM rows.
struct Odometry {
  using Record = OdometryReading;
  static constexpr ReadingKind kReading = ReadingKind::kOdometry;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  static Result<recording::Played<OdometryReading>> load(const HardwareSetup& setup) {
    RAVE_TRY_ASSIGN(const LogPlay play, load_play(setup));
    const bool from_poses = setup.parameters().text("velocity") == "from_poses";
    const recording::PoseTrack track = play.log.track();
    const auto convert = [&](const OdometrySample& sample) {
      OdometryReading reading;
      reading.x_m = sample.X_WR.x;
      reading.y_m = sample.X_WR.y;
      reading.yaw_rad = sample.X_WR.yaw;
      reading.v_mps = sample.v_mps;
      reading.w_radps = sample.w_radps;
      if (from_poses) differentiate(reading, track, sample.t_ns);
      return reading;
    };
    return recording::Played<OdometryReading>{
        recording::state_timeline<OdometryReading>(std::span(play.log.odometry), play.log.start_ns,
                                                   play.log.end_ns, convert),
        report_json(play, "odometry", play.log.odometry_report), play.options.live};
  }
  static void declare(HardwareDeclaration& /*declaration*/) noexcept {}
};

}  // namespace
}  // namespace rave::carmen

RAVE_PLUGIN("carmen_odometry") {
  rave::add_sensor<rave::recording::Player<rave::carmen::Odometry>>(
      registry, {.name = "carmen_odometry",
                 .summary = "Plays the odometry of a robot recorded as a CARMEN log.",
                 .params = rave::carmen::kParams,
                 .clock = rave::DriverClock::kEither});
}
