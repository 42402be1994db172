// SPDX-License-Identifier: Apache-2.0
// The bodies of a step, placed and indexed. Obstacles are placed when they change, robots in each
// step. Queries from many threads read it; no thread writes meanwhile.
#include "rave/world/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::world {
namespace {

constexpr double kCellSize_m = 2.0;
/// Shapes with a larger bounding disc are divided into pieces for the index.
constexpr double kLargestPiece_m = 1.0;
/// A larger movement in one step counts as a jump.
constexpr double kJump_m = 1.0;
/// Pieces this far beside a ray are included too: it covers the rounding of radii up to a
/// kilometre.
constexpr double kRounding_m = 1e-4;
/// Absent robots are placed where no query reaches.
constexpr Vec2 kNowhere{1e12, 1e12};

/// Scratch memory of queries, one per thread, so that queries neither allocate nor lock.
std::vector<std::uint32_t>& scratch() {
  thread_local std::vector<std::uint32_t> found;
  return found;
}

}  // namespace

Snapshot::Snapshot(const WorldModel& model)
    : model_(&model),
      robots_(model.robots.size()),
      turns_(model.robots.size()),
      touch_(model.robots.size()) {
  for (std::uint32_t body = 0; body < model.body_count(); ++body) {
    add_shapes(body, model.body(body));
  }
  end_shapes();
  make_pieces();
  for (std::size_t i = 0; i < model.obstacle_count(); ++i) {
    const Obstacle& obstacle = *model.obstacle(model.obstacle_id(i));
    standing_.push_back({obstacle.X_WB, !obstacle.removed});
    place_obstacle(model.obstacle_id(i));
  }
  index_obstacles();
  for (const Body& body : model.robots) {
    largest_robot_m_ = std::max(largest_robot_m_, body.radius_m());
  }
  find_codes();
  rebuild();
}

// Each list of first indices has one more entry than there are bodies or shapes, so that the end of
// the last one needs no special case. Obstacles that come later go in front of these ends.
void Snapshot::end_shapes() {
  first_shape_.push_back(static_cast<std::uint32_t>(shapes_.size()));
  first_disc_.push_back(static_cast<std::uint32_t>(cover_.size()));
  vertices_.resize(vertices_.size() + kVertexPadding);
  normals_.resize(vertices_.size());
}

void Snapshot::reopen_shapes() {
  first_shape_.pop_back();
  first_disc_.pop_back();
  vertices_.resize(vertices_.size() - kVertexPadding);
  normals_.resize(vertices_.size());
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
    first_disc_.push_back(static_cast<std::uint32_t>(cover_.size()));
    // Two covers: one disc of the whole shape for exact queries, and small ones for the grids.
    const CoverDisc whole = cover(shape, std::numeric_limits<double>::infinity()).front();
    placed.radius_m = whole.radius_m;
    whole_.push_back(whole.centre_B);
    const std::vector<CoverDisc> discs = cover(shape, kLargestPiece_m);
    cover_.insert(cover_.end(), discs.begin(), discs.end());
    placed.z0_m = shape.z0_m;
    placed.z1_m = shape.z1_m;
    shapes_.push_back(placed);
    vertices_.insert(vertices_.end(), shape.vertices().begin(), shape.vertices().end());
    normals_.resize(vertices_.size());
  }
}

void Snapshot::make_pieces() {
  pieces_.resize(cover_.size());
  for (std::uint32_t index = 0; index < shapes_.size(); ++index) {
    const PlacedShape& placed = shapes_[index];
    for (std::uint32_t d = first_disc_[index]; d < first_disc_[index + 1]; ++d) {
      ShapePiece& piece = pieces_[d];
      piece.z0_m = static_cast<float>(placed.z0_m);
      piece.z1_m = static_cast<float>(placed.z1_m);
      piece.body = placed.body;
      piece.index = d;
      piece.shape = index;
      piece.first_vertex = placed.first_vertex;
      piece.vertex_count = static_cast<std::uint8_t>(placed.vertex_count);
      piece.layer = static_cast<std::uint8_t>(placed.layer);
      // Rounded up, because a radius that is too small would miss pieces.
      piece.radius_m = placed.kind == ShapeKind::kDisc
                           ? static_cast<float>(cover_[d].radius_m)
                           : static_cast<float>(cover_[d].radius_m * (1 + 1e-6));
    }
  }
}

void Snapshot::place_obstacle(std::uint32_t body) {
  const auto& [X_WB, present] = standing_[place_of(body)];
  place(body, model_->body(body), X_WB.position(), sincos(X_WB.yaw), present);
}

void Snapshot::set_obstacle(BodyId obstacle, const Pose2& X_WB, bool present) {
  standing_[place_of(obstacle.value())] = {X_WB, present};
  place_obstacle(obstacle.value());
}

void Snapshot::obstacle_added() {
  const std::uint32_t body = first_added() + static_cast<std::uint32_t>(model_->added.size()) - 1;
  reopen_shapes();
  add_shapes(body, model_->body(body));
  end_shapes();
  make_pieces();
  standing_.push_back({model_->added.back().X_WB, false});
  place_obstacle(body);
}

void Snapshot::added_dropped() {
  const std::uint32_t shapes = first_shape_[first_added()];
  reopen_shapes();
  if (shapes < shapes_.size()) {
    vertices_.resize(shapes_[shapes].first_vertex);
    cover_.resize(first_disc_[shapes]);
    first_disc_.resize(shapes);
    shapes_.resize(shapes);
    whole_.resize(shapes);
  }
  first_shape_.resize(first_added());
  end_shapes();
  make_pieces();
  standing_.resize(model_->obstacles.size());
}

void Snapshot::index_obstacles() {
  landmarks_.clear();
  for (std::size_t i = 0; i < standing_.size(); ++i) {
    const std::uint32_t body = model_->obstacle_id(i);
    const Body& description = model_->body(body);
    if (!description.code || !standing_[i].present) continue;
    landmarks_.push_back({BodyId(body), *description.code, standing_[i].X_WB.position(),
                          description.code_z0_m, description.code_z1_m, RobotId(),
                          description.radius_m()});
  }
  fixed_landmarks_ = landmarks_.size();
  rebuild_landmarks();
  // Pieces are in the order obstacles of the start, robots, added obstacles. Without added ones the
  // first part is used in place.
  const auto of_start = std::span(pieces_).first(first_disc_[first_shape_[first_robot()]]);
  if (standing_.size() == model_->obstacles.size()) {
    fixed_.build(of_start, kCellSize_m);
  } else {
    const auto later = std::span(pieces_).subspan(first_disc_[first_shape_[first_added()]]);
    standing_pieces_.assign(of_start.begin(), of_start.end());
    standing_pieces_.insert(standing_pieces_.end(), later.begin(), later.end());
    fixed_.build(standing_pieces_, kCellSize_m);
  }
  ++generation_;
}

double Snapshot::place(std::uint32_t body, const Body& description, Vec2 p_WB, SinCos turn,
                       bool present) {
  double farthest_m2 = 0;
  const std::uint32_t first = first_shape_[body];
  for (std::uint32_t index = first; index < first_shape_[body + 1]; ++index) {
    PlacedShape& placed = shapes_[index];
    placed.centre_W = present ? p_WB + rotate(turn, whole_[index]) : kNowhere;
    if (placed.vertex_count > 0) {
      place_outline(placed, *description.shapes[index - first].polygon, p_WB, turn, present);
    }
    const std::uint32_t discs = first_disc_[index + 1] - first_disc_[index];
    for (std::uint32_t d = first_disc_[index]; d < first_disc_[index + 1]; ++d) {
      ShapePiece& piece = pieces_[d];
      const Vec2 before_W = piece.centre_W;
      piece.centre_W = present ? p_WB + rotate(turn, cover_[d].centre_B) : kNowhere;
      piece.pieces = static_cast<std::uint16_t>(present ? discs : 0);
      const double moved_m2 = squared_norm(piece.centre_W - before_W);
      // A place that is not a number counts as an infinite jump, which voids all lists.
      if (!(moved_m2 <= farthest_m2)) {
        farthest_m2 = std::isnan(moved_m2) ? std::numeric_limits<double>::infinity() : moved_m2;
      }
    }
  }
  return farthest_m2;
}

void Snapshot::place_outline(const PlacedShape& placed, const ConvexPolygon& polygon, Vec2 p_WB,
                             SinCos turn, bool present) {
  for (std::uint32_t k = 0; k < placed.vertex_count; ++k) {
    Vec2& vertex = vertices_[placed.first_vertex + k];
    vertex = present ? p_WB + rotate(turn, polygon.vertices()[k]) : kNowhere;
    normals_[placed.first_vertex + k] = rotate(turn, polygon.normals()[k]);
  }
}

void Snapshot::set_robot(RobotId robot, const RobotState& state) noexcept {
  set_robot(robot, state, sincos(state.X_WR.yaw));
}

void Snapshot::set_touch(RobotId robot, const TouchState& touch) noexcept {
  touch_[robot.value()] = touch;
}

void Snapshot::body_changed(RobotId robot) {
  const Body& body = model_->robots[robot.value()];
  const std::uint32_t first = first_shape_[body_of(robot).value()];
  for (std::size_t i = 0; i < body.shapes.size(); ++i) {
    const std::size_t index = first + i;
    const CoverDisc whole = cover(body.shapes[i], std::numeric_limits<double>::infinity()).front();
    shapes_[index].radius_m = whole.radius_m;
    shapes_[index].layer = body.layer;
    whole_[index] = whole.centre_B;
    const std::vector<CoverDisc> discs = cover(body.shapes[i], kLargestPiece_m);
    const auto at = cover_.begin() + first_disc_[index];
    const auto old_count = first_disc_[index + 1] - first_disc_[index];
    cover_.insert(cover_.erase(at, at + old_count), discs.begin(), discs.end());
    const auto more = static_cast<std::uint32_t>(discs.size()) - old_count;  // modulo 2^32
    // The new shape may have more or fewer pieces; all behind it move.
    for (std::size_t next = index + 1; next < first_disc_.size(); ++next) first_disc_[next] += more;
  }
  make_pieces();
  ++generation_;
  if (!model_->added.empty()) {
    // Obstacles after the robots have other indices now.
    for (std::size_t i = model_->obstacles.size(); i < standing_.size(); ++i) {
      place_obstacle(model_->obstacle_id(i));
    }
    index_obstacles();
  }
  // Never decreases: it is only an upper bound of a search distance.
  largest_robot_m_ = std::max(largest_robot_m_, body.radius_m());
}

void Snapshot::rebuild() { index_robots(place_robots(0, robot_count())); }

double Snapshot::place_robots(std::uint32_t first, std::uint32_t last) {
  const auto obstacle_count = static_cast<std::uint32_t>(model_->obstacles.size());
  double farthest_m2 = 0;
  for (std::uint32_t r = first; r < last; ++r) {
    farthest_m2 =
        std::max(farthest_m2, place(obstacle_count + r, model_->robots[r],
                                    robots_[r].X_WR.position(), turns_[r], robots_[r].present));
  }
  return std::sqrt(farthest_m2);
}

void Snapshot::index_robots(double farthest_m) {
  // A jump would use up the margin of all lists; a new generation voids them at once.
  if (farthest_m <= kJump_m) {
    drift_m_ += farthest_m;
  } else {
    ++generation_;
  }
  const std::uint32_t first = first_disc_[first_shape_[first_robot()]];
  const std::uint32_t last = first_disc_[first_shape_[first_added()]];
  moving_.build(std::span(pieces_).subspan(first, last - first), kCellSize_m);
  rebuild_landmarks();
}

void Snapshot::gather(Vec2 p_W, double radius_m, std::vector<std::uint32_t>& found) const {
  found.clear();
  for_each_near(p_W, radius_m, [&](const ShapePiece& piece) { found.push_back(piece.shape); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

RayHit Snapshot::nearest(Vec2 p_W, Vec2 direction, double z_m, double range_max_m, LayerMask layers,
                         BodyId a, BodyId b) const {
  std::vector<std::uint32_t>& found = scratch();
  RayHit hit;
  std::uint32_t nearest = 0;
  // Part by part, because most rays end early. A hit ends the search once all that could be nearer
  // lies in the parts that were searched.
  for (RayParts parts = parts_of(p_W, range_max_m); parts.next();) {
    found.clear();
    for_each_along(p_W, direction, parts.from_m, parts.to_m, kRounding_m,
                   [&](const ShapePiece& piece) { found.push_back(piece.shape); });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t index : found) {
      const PlacedShape& candidate = shapes_[index];
      if (!contains(layers, candidate.layer) || !candidate.at_height(z_m)) continue;
      // The bodies at both ends of a line of sight do not obstruct it.
      if (candidate.body == a.value() || candidate.body == b.value()) continue;
      const double range = candidate.kind == ShapeKind::kDisc
                               ? cast_disc(p_W, direction, candidate.centre_W, candidate.radius_m)
                               : cast_polygon(p_W, direction, vertices_W(candidate));
      // Of equally near shapes the first by index, in whichever grid it was found.
      const bool nearer = range < hit.range_m || (range == hit.range_m && index < nearest);
      if (!(range <= range_max_m && nearer)) continue;
      hit = {range, BodyId(candidate.body)};
      nearest = index;
    }
    if (hit.range_m <= parts.to_m - kRounding_m) break;
  }
  return hit;
}

double Snapshot::first_part_m() const noexcept {
  // The expected number of discs per metre of a ray: those with centres within their radius beside
  // it.
  const double met_per_m = 2 * (fixed_.pieces_per_m2() * fixed_.mean_radius_m() +
                                moving_.pieces_per_m2() * moving_.mean_radius_m());
  // A search beside a part extends by the largest piece anyway. Of the cells the smaller ones
  // count: those of a few pieces far apart are large, and must not make a part long in the crowd of
  // others.
  return std::max({1 / std::max(met_per_m, 1e-9), std::min(fixed_.cell_m(), moving_.cell_m()),
                   fixed_.largest_radius_m(), moving_.largest_radius_m()});
}

RayParts Snapshot::parts_of(Vec2 p_W, double range_max_m) const noexcept {
  RayParts parts;
  parts.end_m = std::min(range_max_m, std::max(fixed_.farthest_m(p_W), moving_.farthest_m(p_W)));
  parts.step_m = first_part_m();
  return parts;
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
  moving_.for_each_near(p_W, radius_m + largest_robot_m_,
                        [&](const ShapePiece& piece) { shapes.push_back(piece.shape); });
  // Shapes of a robot are next to each other, so doubles are found by comparing neighbours, and the
  // result is in the order of the robots.
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
