// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <span>

#include "carmen/plugins/play.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "recording/player.hpp"

namespace rave::carmen {
namespace {

constexpr auto kParams = recording::join_params(
    kLogParams, std::array<ParamSpec, 2>{
                    number_param("position_sigma_m", "m", 0.03, 0, 10,
                                 "Standard deviation that each of x and y is said to have."),
                    number_param("heading_sigma_deg", "deg", 0.3, 0, 180,
                                 "Standard deviation that the heading is said to have."),
                });

/// Where the laser was at each scan, in the frame of the log.
struct Poses {
  using Record = PoseReading;
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  static Result<recording::Played<PoseReading>> load(const HardwareSetup& setup) {
    RAVE_TRY_ASSIGN(const LogPlay play, load_play(setup));
    const double sigma_m = setup.parameters().number("position_sigma_m");
    const double sigma_rad = deg_to_rad(setup.parameters().number("heading_sigma_deg"));
    const auto convert = [=](const Scan& scan) {
      return PoseReading{scan.X_WL.x, scan.X_WL.y, scan.X_WL.yaw, sigma_m * sigma_m,
                         sigma_rad * sigma_rad};
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
                 .summary = "Plays where the laser of a corrected CARMEN log was at each scan.",
                 .params = rave::carmen::kParams,
                 .clock = rave::DriverClock::kEither});
}
