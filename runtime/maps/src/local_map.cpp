// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/check.hpp"
#include "rave/math/transform.hpp"

namespace rave::maps {
namespace {

constexpr double kNear_m = 8;
constexpr double kFine_m = 0.05;
constexpr double kCoarse_m = 0.1;
/// The number of poses kept: readings arrive later than the poses that belong to them.
constexpr std::size_t kPoses = 128;
constexpr std::uint32_t kTiles = LocalMap::kCells / kTileCells;

bool is_usable(const sim::SensorSample& sample) {
  return sample.info != nullptr && sample.info->kind == ReadingKind::kRanges &&
         sample.info->bearings_rad != nullptr && sample.info->capacity > 0 &&
         sample.info->range_max_m > 0;
}

const std::vector<sim::SensorSpec>& sensors_of(const sim::Engine& engine, RobotId robot) {
  const sim::EngineSpec& spec = engine.spec();
  return spec.types[spec.robots[robot.value()].type].sensors;
}

double longest_m(const sim::Engine& engine, RobotId robot) {
  double longest = 0;
  for (std::uint32_t s = 0; s < sensors_of(engine, robot).size(); ++s) {
    const sim::SensorSample sample = engine.sensor(robot, s);
    if (is_usable(sample)) longest = std::max(longest, sample.info->range_max_m);
  }
  return longest;
}

/// A frame around the robot, aligned to whole tiles so that the maps of several robots fit
/// together.
MapFrame frame_of(const sim::Engine& engine, RobotId robot) {
  MapFrame frame;
  // kNear_m ? kFine_m : kCoarse_m; <= The number of cells is fixed, so smaller cells cover less;
  // sensors of short range can have them.
  frame.resolution_m = longest_m(engine, robot) <= kNear_m ? kFine_m : kCoarse_m;
  frame.columns = frame.rows = LocalMap::kCells;
  const double tile_m = kTileCells * frame.resolution_m;
  const PoseReading& pose = engine.reported(robot).pose;
  const auto origin = [tile_m](double at) {
    return (std::round(at / tile_m) - kTiles / 2.0) * tile_m;
  };
  frame.origin_W = {origin(pose.x_m), origin(pose.y_m)};
  return frame;
}

estimate::OccupancyGrid grid_of(const MapFrame& frame, double longest_m) {
  estimate::BeamModel model;
  model.range_max_m = longest_m;
  // A beam without return may have met something that reflects too little, so only its nearer half
  // marks cells free.
  model.no_return_free_m = 0.5 * longest_m;
  auto grid = estimate::OccupancyGrid::create(
      {frame.resolution_m, frame.origin_W, LocalMap::kCells, LocalMap::kCells}, model);
  RAVE_CHECK(grid.has_value());
  return *std::move(grid);
}

}  // namespace

bool LocalMap::possible(const sim::Engine& engine, RobotId robot) {
  if (!robot.valid() || robot.value() >= engine.spec().robots.size()) return false;
  return engine.is_local(robot) && engine.reported(robot).known && longest_m(engine, robot) > 0;
}

LocalMap::LocalMap(const sim::Engine& engine, RobotId robot)
    : robot_(robot),
      name_(engine.spec().robots[robot.value()].name),
      frame_(frame_of(engine, robot)),
      grid_(grid_of(frame_, longest_m(engine, robot))),
      told_(std::size_t{kTiles} * kTiles) {
  for (std::uint32_t s = 0; s < sensors_of(engine, robot).size(); ++s) {
    if (!is_usable(engine.sensor(robot, s))) continue;
    sensors_.push_back(s);
    sequences_.push_back(0);
  }
}

void LocalMap::follow(const sim::Engine& engine) {
  if (!engine.is_local(robot_)) return;
  const sim::ReportedPose& reported = engine.reported(robot_);
  // In the order of stamps, because pose_at() searches by bisection.
  if (reported.known && (poses_.empty() || reported.stamp.ns > poses_.back().stamp_ns)) {
    if (poses_.size() == kPoses) poses_.pop_front();
    poses_.push_back(
        {reported.stamp.ns, {reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad}});
  }
  // With an old pose the ends of the beams are unknown.
  if (poses_.empty() || reported.stale) return;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const sim::SensorSample sample = engine.sensor(robot_, sensors_[i]);
    if (sample.header == nullptr || sample.header->sequence == sequences_[i]) continue;
    sequences_[i] = sample.header->sequence;
    add(sample);
  }
}

Pose2 LocalMap::pose_at(std::int64_t stamp_ns) const {
  const auto later = std::ranges::lower_bound(poses_, stamp_ns, {}, &PoseAt::stamp_ns);
  if (later == poses_.begin()) return poses_.front().X_WR;
  if (later == poses_.end()) return poses_.back().X_WR;
  const PoseAt& before = *std::prev(later);
  return stamp_ns - before.stamp_ns < later->stamp_ns - stamp_ns ? before.X_WR : later->X_WR;
}

void LocalMap::add(const sim::SensorSample& sample) {
  const SensorInfo& info = *sample.info;
  const std::size_t count = std::min(sample.header->count, info.capacity);
  if (count == 0) return;
  bearings_rad_.assign(info.bearings_rad, info.bearings_rad + count);
  const Pose2 X_WS = compose(pose_at(sample.header->stamp_ns), info.X_RS);
  grid_.add({X_WS, bearings_rad_, {static_cast<const float*>(sample.records), count}});
  newest_ns_ = std::max(newest_ns_, sample.header->stamp_ns);
  touch(X_WS.position(), info.range_max_m);
}

void LocalMap::touch(Vec2 p_W, double range_m) {
  const double tile_m = kTileCells * frame_.resolution_m;
  const auto tile = [&](double at, double origin) {
    const double index = std::floor((at - origin) / tile_m);
    // One tile beyond the map stands for everything farther out. It keeps the conversion defined,
    // and a circle outside the map gives an empty range.
    return static_cast<std::int64_t>(std::clamp(index, -1.0, static_cast<double>(kTiles)));
  };
  const bool none = column1_ < column0_;
  const auto extend = [none](std::int64_t& low, std::int64_t& high, std::int64_t a,
                             std::int64_t b) {
    low = std::max<std::int64_t>(none ? a : std::min(low, a), 0);
    high = std::min<std::int64_t>(none ? b : std::max(high, b), kTiles - 1);
  };
  extend(column0_, column1_, tile(p_W.x - range_m, frame_.origin_W.x),
         tile(p_W.x + range_m, frame_.origin_W.x));
  extend(row0_, row1_, tile(p_W.y - range_m, frame_.origin_W.y),
         tile(p_W.y + range_m, frame_.origin_W.y));
}

std::vector<std::uint8_t> LocalMap::cells_of(std::uint32_t column, std::uint32_t row,
                                             bool& known) const {
  std::vector<std::uint8_t> cells;
  cells.reserve(std::size_t{kTileCells} * kTileCells);
  known = false;
  for (std::uint32_t y = row * kTileCells; y < (row + 1) * kTileCells; ++y) {
    for (std::uint32_t x = column * kTileCells; x < (column + 1) * kTileCells; ++x) {
      if (!grid_.seen(static_cast<int>(x), static_cast<int>(y))) {
        cells.push_back(kUnknown);
        continue;
      }
      known = true;
      const double percent = 100 * grid_.probability(static_cast<int>(x), static_cast<int>(y));
      cells.push_back(static_cast<std::uint8_t>(std::lround(percent)));
    }
  }
  return cells;
}

void LocalMap::put_changed(std::vector<MapTile>& tiles) {
  for (std::int64_t row = row0_; row <= row1_; ++row) {
    for (std::int64_t column = column0_; column <= column1_; ++column) {
      Told& told = told_[static_cast<std::size_t>(row) * kTiles + static_cast<std::size_t>(column)];
      bool known = false;
      auto cells =
          cells_of(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), known);
      if (!known || cells == told.cells) continue;
      told.cells = cells;
      tiles.push_back({name_, robot_.value(), frame_, static_cast<std::uint32_t>(column),
                       static_cast<std::uint32_t>(row), ++told.revision, SimTime{newest_ns_},
                       std::move(cells)});
    }
  }
  column0_ = row0_ = 0;
  column1_ = row1_ = -1;
}

}  // namespace rave::maps
