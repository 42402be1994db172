// SPDX-License-Identifier: Apache-2.0
#include "rave/world/snapshot.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::world {
namespace {

constexpr double kCellSize_m = 2.0;
/// Robots that are not in the world are parked where no query reaches.
constexpr Vec2 kNowhere{1e12, 1e12};

/// Scratch space of queries. One for each thread, so that queries neither allocate nor lock.
std::vector<std::uint32_t>& scratch() {
  thread_local std::vector<std::uint32_t> found;
  return found;
}

struct BoundingDisc {
  Vec2 centre;
  double radius_m = 0;
};

BoundingDisc bound(const Shape& shape) noexcept {
  if (shape.kind == ShapeKind::kDisc) return {shape.centre, shape.radius_m};
  Vec2 low = shape.vertices().front();
  Vec2 high = low;
  for (const Vec2 v : shape.vertices()) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y)};
  }
  BoundingDisc disc{0.5 * (low + high), 0};
  for (const Vec2 v : shape.vertices()) {
    disc.radius_m = std::max(disc.radius_m, std::sqrt(squared_norm(v - disc.centre)));
  }
  return disc;
}

}  // namespace

Snapshot::Snapshot(const WorldModel& model)
    : model_(&model), robots_(model.robots.size()), touch_(model.robots.size()) {
  for (std::uint32_t body = 0; body < model.body_count(); ++body) {
    add_shapes(body, model.body(body));
  }
  first_shape_.push_back(static_cast<std::uint32_t>(shapes_.size()));
  std::vector<GridItem> fixed;
  for (std::uint32_t body = 0; body < model.obstacles.size(); ++body) {
    const Obstacle& obstacle = model.obstacles[body];
    place(body, obstacle.body, obstacle.X_WB, true);
    for (std::uint32_t i = first_shape_[body]; i < first_shape_[body + 1]; ++i) {
      fixed.push_back({shapes_[i].centre_W, shapes_[i].radius_m, i});
    }
    if (obstacle.body.code) {
      fixed_landmarks_.push_back({BodyId(body), *obstacle.body.code, obstacle.X_WB.position(),
                                  obstacle.body.code_z0_m, obstacle.body.code_z1_m, RobotId(),
                                  obstacle.body.radius_m()});
    }
  }
  fixed_grid_.build(fixed, kCellSize_m);
  for (const Body& body : model.robots) {
    largest_robot_m_ = std::max(largest_robot_m_, body.radius_m());
  }
  rebuild();
}

void Snapshot::add_shapes(std::uint32_t body, const Body& description) {
  first_shape_.push_back(static_cast<std::uint32_t>(shapes_.size()));
  for (const Shape& shape : description.shapes) {
    PlacedShape placed;
    placed.body = body;
    placed.kind = shape.kind;
    placed.layer = description.layer;
    placed.first_vertex = static_cast<std::uint32_t>(vertices_.size());
    placed.vertex_count = static_cast<std::uint32_t>(shape.vertices().size());
    placed.radius_m = bound(shape).radius_m;
    placed.z0_m = shape.z0_m;
    placed.z1_m = shape.z1_m;
    shapes_.push_back(placed);
    vertices_.insert(vertices_.end(), shape.vertices().begin(), shape.vertices().end());
  }
}

void Snapshot::place(std::uint32_t body, const Body& description, const Pose2& X_WB, bool present) {
  const SinCos turn = sincos(X_WB.yaw);
  const Vec2 p_WB = X_WB.position();
  for (std::size_t i = 0; i < description.shapes.size(); ++i) {
    const Shape& shape = description.shapes[i];
    PlacedShape& placed = shapes_[first_shape_[body] + i];
    placed.centre_W = present ? p_WB + rotate(turn, bound(shape).centre) : kNowhere;
    for (std::size_t k = 0; k < shape.vertices().size(); ++k) {
      vertices_[placed.first_vertex + k] =
          present ? p_WB + rotate(turn, shape.vertices()[k]) : kNowhere;
    }
  }
}

void Snapshot::set_robot(RobotId robot, const RobotState& state) noexcept {
  robots_[robot.value()] = state;
}

void Snapshot::set_touch(RobotId robot, const TouchState& touch) noexcept {
  touch_[robot.value()] = touch;
}

void Snapshot::body_changed(RobotId robot) {
  const Body& body = model_->robots[robot.value()];
  const std::uint32_t first = first_shape_[body_of(robot).value()];
  for (std::size_t i = 0; i < body.shapes.size(); ++i) {
    shapes_[first + i].radius_m = bound(body.shapes[i]).radius_m;
  }
  // Never smaller: it only says how far a query has to look.
  largest_robot_m_ = std::max(largest_robot_m_, body.radius_m());
}

void Snapshot::rebuild() {
  thread_local std::vector<GridItem> moving;
  moving.clear();
  const auto obstacle_count = static_cast<std::uint32_t>(model_->obstacles.size());
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    const std::uint32_t body = obstacle_count + r;
    place(body, model_->robots[r], robots_[r].X_WR, robots_[r].present);
    if (!robots_[r].present) continue;
    for (std::uint32_t i = first_shape_[body]; i < first_shape_[body + 1]; ++i) {
      moving.push_back({shapes_[i].centre_W, shapes_[i].radius_m, i});
    }
  }
  moving_grid_.build(moving, kCellSize_m);
  rebuild_landmarks();
}

void Snapshot::rebuild_landmarks() {
  landmarks_ = fixed_landmarks_;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    const Body& body = model_->robots[r];
    if (!body.code || !robots_[r].present) continue;
    landmarks_.push_back({body_of(RobotId(r)), *body.code, robots_[r].X_WR.position(),
                          body.code_z0_m, body.code_z1_m, RobotId(r), 0});
  }
}

void Snapshot::gather(Vec2 p_W, double radius_m, std::vector<std::uint32_t>& found) const {
  found.clear();
  fixed_grid_.gather(p_W, radius_m, found);
  moving_grid_.gather(p_W, radius_m, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

RayHit Snapshot::nearest(Vec2 p_W, Vec2 direction, double z_m, double range_max_m, LayerMask layers,
                         BodyId a, BodyId b) const {
  std::vector<std::uint32_t>& found = scratch();
  gather(p_W + 0.5 * range_max_m * direction, 0.5 * range_max_m, found);
  RayHit hit;
  for (const std::uint32_t index : found) {
    const PlacedShape& candidate = shapes_[index];
    if (!contains(layers, candidate.layer) || !candidate.at_height(z_m)) continue;
    if (candidate.body == a.value() || candidate.body == b.value()) continue;
    const double range = candidate.kind == ShapeKind::kDisc
                             ? cast_disc(p_W, direction, candidate.centre_W, candidate.radius_m)
                             : cast_polygon(p_W, direction, vertices_W(candidate));
    if (range <= range_max_m && range < hit.range_m) hit = {range, BodyId(candidate.body)};
  }
  return hit;
}

std::uint32_t Snapshot::robot_count() const noexcept {
  return static_cast<std::uint32_t>(robots_.size());
}

BodyId Snapshot::body_of(RobotId robot) const noexcept {
  return BodyId(static_cast<std::uint32_t>(model_->obstacles.size()) + robot.value());
}

Pose2 Snapshot::pose(RobotId robot) const noexcept { return robots_[robot.value()].X_WR; }

Twist2 Snapshot::velocity_W(RobotId robot) const noexcept {
  return robots_[robot.value()].velocity_W;
}

Layer Snapshot::layer_of(BodyId body) const noexcept { return model_->body(body.value()).layer; }

std::span<const Landmark> Snapshot::landmarks() const noexcept { return landmarks_; }

RayHit Snapshot::cast(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                      LayerMask layers, BodyId skip) const noexcept {
  const SinCos turn = sincos(bearing_rad);
  return nearest(p_W, {turn.cos, turn.sin}, z_m, range_max_m, layers, skip, BodyId());
}

bool Snapshot::visible(Vec2 p_from, Vec2 p_to, double z_m, LayerMask layers, BodyId a,
                       BodyId b) const noexcept {
  const Vec2 apart = p_to - p_from;
  const double distance = std::sqrt(squared_norm(apart));
  if (distance == 0) return true;
  const RayHit hit = nearest(p_from, (1.0 / distance) * apart, z_m, distance, layers, a, b);
  return !hit.body.valid();
}

std::uint32_t Snapshot::robots_within(Vec2 p_W, double radius_m,
                                      std::span<RobotId> found) const noexcept {
  std::vector<std::uint32_t>& shapes = scratch();
  shapes.clear();
  moving_grid_.gather(p_W, radius_m + largest_robot_m_, shapes);
  std::sort(shapes.begin(), shapes.end());
  const auto obstacle_count = static_cast<std::uint32_t>(model_->obstacles.size());
  std::uint32_t count = 0;
  std::uint32_t last = RobotId::kNone;
  for (const std::uint32_t index : shapes) {
    const std::uint32_t robot = shapes_[index].body - obstacle_count;
    if (robot == last) continue;
    last = robot;
    if (squared_norm(robots_[robot].X_WR.position() - p_W) > radius_m * radius_m) continue;
    if (count < found.size()) found[count] = RobotId(robot);
    ++count;
  }
  return count;
}

TouchState Snapshot::touch(RobotId robot) const noexcept { return touch_[robot.value()]; }

}  // namespace rave::world
