// SPDX-License-Identifier: Apache-2.0
#include "carmen_map/build_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "carmen/notes.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/trigonometry.hpp"

namespace rave::tools {
namespace {

constexpr int kMarginCells = 4;
constexpr std::int64_t kLeastScans = 10;
constexpr float kFar_m = std::numeric_limits<float>::infinity();

/// The smallest rectangle around what the scans saw.
struct Bounds {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void take(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

Bounds bounds_of(const carmen::Log& log, std::span<const double> bearings_rad, double range_max_m) {
  Bounds bounds;
  for (const carmen::Scan& scan : log.scans) {
    bounds.take(scan.X_WL.position());
    const auto ranges_m = log.ranges(scan);
    for (std::size_t i = 0; i < ranges_m.size(); ++i) {
      const auto range_m = static_cast<double>(ranges_m[i]);
      if (!(range_m <= range_max_m)) continue;
      const SinCos turn = sincos(scan.X_WL.yaw + bearings_rad[i]);
      bounds.take(scan.X_WL.position() + range_m * Vec2{turn.cos, turn.sin});
    }
  }
  return bounds;
}

/// Corners on whole multiples of the cell, so that maps of one log lie on one raster.
estimate::GridFrame frame_of(const Bounds& bounds, double resolution_m) {
  const auto cell = [=](double x) { return static_cast<int>(std::floor(x / resolution_m)); };
  const int left = cell(bounds.low.x) - kMarginCells;
  const int bottom = cell(bounds.low.y) - kMarginCells;
  return {resolution_m,
          {left * resolution_m, bottom * resolution_m},
          cell(bounds.high.x) + kMarginCells + 1 - left,
          cell(bounds.high.y) + kMarginCells + 1 - bottom};
}

/// MapFiles::poor.
std::string poor(const carmen::Log& log) {
  const auto used = static_cast<std::int64_t>(log.scans.size());
  const std::int64_t of = used + log.scan_report.dropped() +
                          log.scan_report.repaired(recording::RepairKind::kJunkStamp);
  const bool any =
      std::ranges::any_of(log.ranges_m, [](float range_m) { return range_m < kFar_m; });
  if (!any) return "a map without a ray that met something: each one is without return";
  if (used >= kLeastScans && 2 * used >= of) return {};
  std::string text = fmt::format("a map of {} of the {} scans of the log", used, of);
  for (const std::string& why : log.refusals) text += "\n  refused: " + why;
  return text;
}

}  // namespace

Result<MapFiles> build_map(const MapOptions& options, const std::string& image_name) {
  carmen::LoadOptions load;
  load.side = options.side;
  load.no_return_m = options.no_return_m;
  load.order_suffices = true;
  RAVE_TRY_ASSIGN(carmen::Log log, carmen::load(options.log, load));
  if (!log.poses) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}`: {} rows have no pose, and there is no ODOM row to take it from",
                options.log.string(), log.message->name);
  }
  std::erase_if(log.scans, [&](const carmen::Scan& scan) {
    return scan.t_ns < log.start_ns || scan.t_ns > log.end_ns;
  });
  RAVE_TRY_ASSIGN(std::vector<double> bearings_rad, carmen::bearings_rad(log, options.fov_deg));
  for (double& bearing_rad : bearings_rad) bearing_rad += deg_to_rad(options.yaw_deg);
  const Bounds bounds = bounds_of(log, bearings_rad, options.beams.range_max_m);
  RAVE_TRY_ASSIGN(
      estimate::OccupancyGrid grid,
      estimate::OccupancyGrid::create(frame_of(bounds, options.resolution_m), options.beams));
  for (const carmen::Scan& scan : log.scans) {
    grid.add({scan.X_WL, bearings_rad, log.ranges(scan)});
  }
  const std::string comment =
      fmt::format("# Made by rave-carmen-map from {} scans of {} (SHA-256 {}).\n", log.scans.size(),
                  log.scan_report.file, log.scan_report.sha256);
  return MapFiles{estimate::map_image(grid, options.thresholds),
                  estimate::map_yaml(grid.frame(), options.thresholds, image_name, comment),
                  fmt::format("{} scans, {} x {} cells of {} m", log.scans.size(),
                              grid.frame().columns, grid.frame().rows, options.resolution_m),
                  carmen::notes(log, log.scan_report.file, log.scan_report), poor(log)};
}

}  // namespace rave::tools
