// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/exponential.hpp"

namespace rave::maps {
namespace {

static_assert(estimate::RobotMap::kTileCells == kTileCells);

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

}  // namespace

bool LocalMap::possible(const sim::Engine& engine, RobotId robot) {
  if (!robot.valid() || robot.value() >= engine.spec().robots.size()) return false;
  if (!engine.is_local(robot)) return false;
  if (engine.program_map(robot).log_odds != nullptr) return true;
  return engine.reported(robot).known && longest_m(engine, robot) > 0;
}

LocalMap::LocalMap(const sim::Engine& engine, RobotId robot)
    : robot_(robot), name_(engine.spec().robots[robot.value()].name) {
  if (engine.program_map(robot).log_odds != nullptr) return;
  const PoseReading& pose = engine.reported(robot).pose;
  own_.emplace(Vec2{pose.x_m, pose.y_m}, longest_m(engine, robot));
  for (std::uint32_t s = 0; s < sensors_of(engine, robot).size(); ++s) {
    if (!is_usable(engine.sensor(robot, s))) continue;
    sensors_.push_back(s);
    sequences_.push_back(0);
  }
}

void LocalMap::follow(const sim::Engine& engine) {
  if (!own_ || !engine.is_local(robot_)) return;
  const sim::ReportedPose& reported = engine.reported(robot_);
  if (reported.known) {
    own_->follow(reported.stamp.ns, {reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad});
  }
  // With an old pose the ends of the beams are unknown.
  if (reported.stale) return;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const sim::SensorSample sample = engine.sensor(robot_, sensors_[i]);
    if (sample.header == nullptr || sample.header->sequence == sequences_[i]) continue;
    sequences_[i] = sample.header->sequence;
    add(sensors_[i], sample);
  }
}

void LocalMap::add(std::uint32_t sensor, const sim::SensorSample& sample) {
  const SensorInfo& info = *sample.info;
  const std::size_t count = std::min(sample.header->count, info.capacity);
  bearings_rad_.assign(info.bearings_rad, info.bearings_rad + count);
  own_->add({sensor,
             sample.header->stamp_ns,
             info.X_RS,
             info.range_max_m,
             info.cone_rad,
             bearings_rad_,
             {static_cast<const float*>(sample.records), count}});
}

MapView LocalMap::view(const sim::Engine& engine) const {
  if (!own_) return engine.program_map(robot_);
  const estimate::GridFrame& frame = own_->grid().frame();
  return {frame.resolution_m,
          frame.origin_W,
          static_cast<std::uint32_t>(frame.columns),
          static_cast<std::uint32_t>(frame.rows),
          own_->grid().all_log_odds().data(),
          own_->grid().all_seen().data(),
          own_->touched().data(),
          own_->newest_ns()};
}

std::vector<std::uint8_t> tile_cells(const MapView& map, std::uint32_t column, std::uint32_t row,
                                     bool& known) {
  std::vector<std::uint8_t> cells;
  cells.reserve(std::size_t{kTileCells} * kTileCells);
  known = false;
  for (std::uint32_t y = row * kTileCells; y < (row + 1) * kTileCells; ++y) {
    for (std::uint32_t x = column * kTileCells; x < (column + 1) * kTileCells; ++x) {
      const std::size_t at = std::size_t{y} * map.columns + x;
      if (map.seen[at] == 0) {
        cells.push_back(kUnknown);
        continue;
      }
      known = true;
      const double percent = 100 / (1 + exp(-map.log_odds[at]));
      cells.push_back(static_cast<std::uint8_t>(std::lround(percent)));
    }
  }
  return cells;
}

void LocalMap::put_changed(const sim::Engine& engine, std::vector<MapTile>& tiles) {
  const MapView map = view(engine);
  if (map.log_odds == nullptr || map.columns % kTileCells != 0 || map.rows % kTileCells != 0) {
    return;
  }
  const std::uint32_t across = map.columns / kTileCells;
  told_.resize(std::size_t{across} * (map.rows / kTileCells));
  for (std::uint32_t at = 0; at < told_.size(); ++at) {
    Told& told = told_[at];
    if (map.touched[at] == told.touched) continue;
    told.touched = map.touched[at];
    bool known = false;
    auto cells = tile_cells(map, at % across, at / across, known);
    if (!known || cells == told.cells) continue;
    told.cells = cells;
    tiles.push_back({name_,
                     robot_.value(),
                     {map.resolution_m, map.origin_W, map.columns, map.rows},
                     at % across,
                     at / across,
                     ++told.revision,
                     SimTime{map.stamp_ns},
                     std::move(cells)});
  }
}

}  // namespace rave::maps
