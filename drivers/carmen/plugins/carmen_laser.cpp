// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <vector>

#include "carmen/plugins/play.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "recording/player.hpp"

namespace rave::carmen {
namespace {

constexpr auto kParams = recording::join_params(
    kLogParams,
    std::array<ParamSpec, 4>{
        number_param("fov_deg", "deg", 0, 0, 360,
                     "Angle from the first ray to the last, symmetric about the sensor's x axis; "
                     "0: the directions that the rows give. FLASER and RLASER rows give none."),
        number_param("range_min_m", "m", 0.02, 0, 1000,
                     "Smallest range; nearer bodies read as this."),
        number_param("range_max_m", "m", 80, 0.1, 1000,
                     "Ranges from this value on count as no return."),
        number_param("no_return_m", "m", -1, -1, 1000,
                     "The range that the log writes for no return; -1: found in the log, as the "
                     "largest range if it is far more frequent than others; 0: none."),
    });

/// The scans of the front laser.
class Laser {
 public:
  using Record = float;
  static constexpr ReadingKind kReading = ReadingKind::kRanges;
  // Replaced by declare(), when the number of rays is known.
  static constexpr std::uint32_t kCapacity = 1;
  static constexpr std::uint32_t kCollect = 0;

  Result<recording::Played<float>> load(const HardwareSetup& setup) {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    range_min_m_ = params.number("range_min_m");
    range_max_m_ = params.number("range_max_m");
    RAVE_TRY_ASSIGN(const LogPlay play,
                    load_play(setup, {range_max_m_, params.number("no_return_m")}));
    RAVE_TRY_ASSIGN(bearings_rad_, bearings_rad(play.log, params.number("fov_deg")));
    return recording::Played<float>{
        timeline(play.log), report_json(play, "scans", play.log.scan_report), play.options.live};
  }

  void declare(HardwareDeclaration& declaration) const noexcept {
    declaration.bearings_rad = bearings_rad_.data();
    declaration.capacity = static_cast<std::uint32_t>(bearings_rad_.size());
    declaration.range_min_m = range_min_m_;
    declaration.range_max_m = range_max_m_;
  }

 private:
  /// The last scan before the start is kept, so that there is a state from the first step on.
  [[nodiscard]] recording::Timeline<float> timeline(const Log& log) const {
    recording::Timeline<float> timeline;
    const auto least = static_cast<float>(range_min_m_);
    for (std::size_t i = 0; i < log.scans.size() && log.scans[i].t_ns <= log.end_ns; ++i) {
      const bool before = log.scans[i].t_ns < log.start_ns;
      const bool held = i + 1 < log.scans.size() && log.scans[i + 1].t_ns <= log.start_ns;
      if (before && held) continue;
      timeline.begin(std::max(SimTime{}, SimTime{log.scans[i].t_ns - log.start_ns}));
      // NaN stays what it is.
      for (const float range_m : log.ranges(log.scans[i])) {
        timeline.add(range_m < least ? least : range_m);
      }
    }
    return timeline;
  }

  std::vector<double> bearings_rad_;
  double range_min_m_ = 0;
  double range_max_m_ = 0;
};

}  // namespace
}  // namespace rave::carmen

RAVE_PLUGIN("carmen_laser") {
  rave::add_sensor<rave::recording::Player<rave::carmen::Laser>>(
      registry, {.name = "carmen_laser",
                 .summary = "Plays the front laser of a robot recorded as a CARMEN log.",
                 .params = rave::carmen::kParams,
                 .clock = rave::DriverClock::kEither});
}
