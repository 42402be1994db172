// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/robot_map.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/check.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::estimate {
namespace {

constexpr double kNear_m = 8;
constexpr double kFine_m = 0.05;
constexpr double kCoarse_m = 0.1;
/// The number of poses kept: readings arrive later than the poses that belong to them.
constexpr std::size_t kPoses = 128;
/// A cone counts again when its sensor has moved or turned by this much, or reads another range.
constexpr double kMoved_m = 0.05;
constexpr double kTurned_rad = deg_to_rad(8);
constexpr float kChanged_m = 0.1F;

/// A frame around the robot.
GridFrame frame_at(Vec2 first_W, double longest_m) {
  GridFrame frame;
  // The number of cells is fixed, so smaller cells cover less; sensors of short range can have
  // them.
  frame.resolution_m = longest_m <= kNear_m ? kFine_m : kCoarse_m;
  frame.columns = frame.rows = RobotMap::kCells;
  const double tile_m = RobotMap::kTileCells * frame.resolution_m;
  const auto origin = [tile_m](double at) {
    return (std::round(at / tile_m) - RobotMap::kTiles / 2.0) * tile_m;
  };
  frame.origin_W = {origin(first_W.x), origin(first_W.y)};
  return frame;
}

OccupancyGrid grid_at(Vec2 first_W, double longest_m) {
  BeamModel model;
  model.range_max_m = longest_m;
  // A beam without return may have met something that reflects too little, so only its nearer half
  // marks cells free.
  model.no_return_free_m = 0.5 * longest_m;
  auto grid = OccupancyGrid::create(frame_at(first_W, longest_m), model);
  RAVE_CHECK(grid.has_value());
  return *std::move(grid);
}

}  // namespace

RobotMap::RobotMap(Vec2 first_W, double longest_m)
    : grid_(grid_at(first_W, longest_m)), touched_(std::size_t{kTiles} * kTiles, 0) {}

void RobotMap::follow(std::int64_t stamp_ns, const Pose2& X_WR) {
  // In the order of stamps, because pose_at() searches by bisection.
  if (!poses_.empty() && stamp_ns <= poses_.back().stamp_ns) return;
  if (poses_.size() == kPoses) poses_.pop_front();
  poses_.push_back({stamp_ns, X_WR});
}

Pose2 RobotMap::pose_at(std::int64_t stamp_ns) const {
  const auto later = std::ranges::lower_bound(poses_, stamp_ns, {}, &PoseAt::stamp_ns);
  if (later == poses_.begin()) return poses_.front().X_WR;
  if (later == poses_.end()) return poses_.back().X_WR;
  const PoseAt& before = *std::prev(later);
  return stamp_ns - before.stamp_ns < later->stamp_ns - stamp_ns ? before.X_WR : later->X_WR;
}

void RobotMap::add(const RangeSample& sample) {
  if (poses_.empty() || sample.ranges_m.empty()) return;
  ++samples_;
  const Pose2 X_WS = compose(pose_at(sample.stamp_ns), sample.X_RS);
  if (sample.cone_rad > 0) {
    add_cones(sample, X_WS);
  } else {
    grid_.add({X_WS, sample.bearings_rad, sample.ranges_m});
  }
  newest_ns_ = std::max(newest_ns_, sample.stamp_ns);
  touch(X_WS.position(), sample.range_max_m);
}

void RobotMap::add_cones(const RangeSample& sample, const Pose2& X_WS) {
  for (std::size_t i = 0; i < sample.ranges_m.size(); ++i) {
    const float range_m = sample.ranges_m[i];
    if (!is_news({sample.sensor, static_cast<std::uint32_t>(i), X_WS, range_m})) continue;
    grid_.add(ConeView{X_WS, sample.bearings_rad[i], sample.cone_rad, range_m});
  }
}

bool RobotMap::is_news(const LastCone& cone) {
  const auto last = std::ranges::find_if(cones_, [&](const LastCone& other) {
    return other.sensor == cone.sensor && other.index == cone.index;
  });
  if (last == cones_.end()) {
    cones_.push_back(cone);
    return true;
  }
  const bool moved =
      squared_norm(cone.X_WS.position() - last->X_WS.position()) >= kMoved_m * kMoved_m ||
      std::abs(wrap_angle(cone.X_WS.yaw - last->X_WS.yaw)) >= kTurned_rad;
  // NaN and infinity: only the difference of two numbers is a change.
  const bool same = cone.range_m == last->range_m ||
                    std::abs(cone.range_m - last->range_m) < kChanged_m ||
                    (std::isnan(cone.range_m) && std::isnan(last->range_m));
  if (!moved && same) return false;
  *last = cone;
  return true;
}

void RobotMap::touch(Vec2 p_W, double range_m) {
  const GridFrame& frame = grid_.frame();
  const double tile_m = kTileCells * frame.resolution_m;
  const auto tile = [&](double at, double origin) {
    // One tile beyond the map stands for everything farther out. It keeps the conversion defined.
    return static_cast<int>(
        std::clamp(std::floor((at - origin) / tile_m), -1.0, static_cast<double>(kTiles)));
  };
  const int row1 = std::min(tile(p_W.y + range_m, frame.origin_W.y), kTiles - 1);
  const int column1 = std::min(tile(p_W.x + range_m, frame.origin_W.x), kTiles - 1);
  for (int row = std::max(tile(p_W.y - range_m, frame.origin_W.y), 0); row <= row1; ++row) {
    for (int column = std::max(tile(p_W.x - range_m, frame.origin_W.x), 0); column <= column1;
         ++column) {
      touched_[static_cast<std::size_t>(row * kTiles + column)] = samples_;
    }
  }
}

}  // namespace rave::estimate
