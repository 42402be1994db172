// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rave/math/pose.hpp"
#include "rave/math/trigonometry.hpp"
#include "rave/world/placed_shape.hpp"
#include "rave/world/shape_grid.hpp"
#include "rave/world/world_view.hpp"

namespace rave::world {

/// The state of a robot at one time, as other robots sense it.
struct RobotState {
  Pose2 X_WR;
  Twist2 velocity_W;     ///< Velocity of the origin over ground, in the axes of W.
  bool present = false;  ///< False before the first pose of a real robot: it cannot be sensed.
};

/// A long ray, divided into parts of growing length. A query stops after the part with the first
/// hit, so it visits few pieces behind it.
struct RayParts {
  double from_m = 0;
  double to_m = 0;
  double step_m = 1;  ///< Length of the next part.
  double end_m = 0;   ///< No piece is farther along the ray.
  bool begun = false;

  /// Advances to the next part; false if there is none. There is always a first part.
  [[nodiscard]] bool next() noexcept {
    if (begun && !(to_m < end_m)) return false;
    begun = true;
    from_m = to_m;
    to_m = std::min(to_m + step_m, end_m);
    step_m *= 2;
    return true;
  }
};

/// The world at one time, for queries. Set the robots, call rebuild(), then query from any number
/// of threads until the next set_robot(). No allocation after the first rebuild() of a world,
/// unless its obstacles change. It keeps a pointer to the model, which must outlive it. Obstacles
/// start at their poses in the model and then follow set_obstacle(), so that a snapshot of the past
/// can show their past poses.
class Snapshot final : public WorldView {
 public:
  explicit Snapshot(const WorldModel& model);

  void set_time(SimTime time) noexcept { time_ = time; }
  void set_robot(RobotId robot, const RobotState& state) noexcept;
  /// Like the above; `turn` must be sincos(state.X_WR.yaw), for callers that already have it.
  void set_robot(RobotId robot, const RobotState& state, SinCos turn) noexcept {
    robots_[robot.value()] = state;
    turns_[robot.value()] = turn;
  }
  void set_touch(RobotId robot, const TouchState& touch) noexcept;
  /// Call it after the model's body of this robot has changed, with as many shapes and corners as
  /// before. Takes effect with the next rebuild().
  void body_changed(RobotId robot);
  /// Call it after an obstacle was appended to WorldModel::added. The obstacle is absent until
  /// set_obstacle().
  void obstacle_added();
  /// Call it after WorldModel::added was cleared. Initial obstacles stay at their poses.
  void added_dropped();
  /// Sets the pose of an obstacle, or removes it; takes effect with the next index_obstacles().
  void set_obstacle(BodyId obstacle, const Pose2& X_WB, bool present);
  /// Rebuilds the grid of obstacles; generation() changes. No other thread may query meanwhile.
  void index_obstacles();
  /// The pose of an obstacle; of a removed one the last.
  [[nodiscard]] Pose2 obstacle_pose(BodyId obstacle) const noexcept {
    return standing_[place_of(obstacle.value())].X_WB;
  }

  /// Moves all shapes of robots to their poses and rebuilds their grid.
  void rebuild();
  /// The parts of rebuild(). place_robots() moves the shapes of robots [first, last) to their poses
  /// and returns the largest distance that a piece moved, in metres. Several threads may set and
  /// place disjoint robots at once. Then one thread calls index_robots() with the largest of these
  /// distances; queries are permitted again after that.
  double place_robots(std::uint32_t first, std::uint32_t last);
  void index_robots(double farthest_m);

  /// For callers that keep results of earlier queries: if generation() is unchanged, no piece of a
  /// robot has moved farther than drift_m() has grown. The generation changes when a robot appears,
  /// vanishes, jumps by more than a metre, or gets another body, and when obstacles change.
  [[nodiscard]] double drift_m() const noexcept { return drift_m_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }

  /// Writes to `found` the indices of shapes whose bounding disc comes within `radius_m` of a
  /// point, ascending and without duplicates; its old content is dropped.
  void gather(Vec2 p_W, double radius_m, std::vector<std::uint32_t>& found) const;

  /// Calls `visit(piece)` for each piece that comes within `radius_m` of a point. A shape with
  /// several pieces may be visited several times. The order is deterministic.
  template <class Visit>
  void for_each_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    for_each_standing_near(p_W, radius_m, visit);
    for_each_robot_near(p_W, radius_m, visit);
  }
  /// Like for_each_near(), for pieces of obstacles only, and of robots only.
  template <class Visit>
  void for_each_standing_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    fixed_.for_each_near(p_W, radius_m, visit);
  }
  template <class Visit>
  void for_each_robot_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    moving_.for_each_near(p_W, radius_m, visit);
  }
  /// Calls `visit(piece)` for each piece that comes within `width_m` of a part of a ray; see
  /// for_each_near() and ShapeGrid::for_each_along().
  template <class Visit>
  void for_each_along(Vec2 p_W, Vec2 direction, double from_m, double to_m, double width_m,
                      Visit&& visit) const {
    fixed_.for_each_along(p_W, direction, from_m, to_m, width_m, visit);
    moving_.for_each_along(p_W, direction, from_m, to_m, width_m, visit);
  }
  /// Recommended length of the first part of a ray in metres: the mean distance to the first hit.
  [[nodiscard]] double first_part_m() const noexcept;
  /// The parts of a ray that begins at p_W.
  [[nodiscard]] RayParts parts_of(Vec2 p_W, double range_max_m) const noexcept;
  /// The grids of obstacles and of robots, for custom queries.
  [[nodiscard]] const ShapeGrid& standing() const noexcept { return fixed_; }
  [[nodiscard]] const ShapeGrid& moving() const noexcept { return moving_; }
  /// All vertices, and the outward unit normal of the edge from each to the next of its shape;
  /// ShapePiece::first_vertex is the first one of a piece. kVertexPadding more elements follow.
  [[nodiscard]] const Vec2* vertices_W() const noexcept { return vertices_.data(); }
  [[nodiscard]] const Vec2* normals_W() const noexcept { return normals_.data(); }

  /// All pieces, each at its ShapePiece::index, which is constant while generation() is. Pieces of
  /// absent bodies are where no query reaches.
  [[nodiscard]] const ShapePiece* pieces() const noexcept { return pieces_.data(); }

  [[nodiscard]] const PlacedShape& shape(std::uint32_t index) const noexcept {
    return shapes_[index];
  }
  [[nodiscard]] std::span<const Vec2> vertices_W(const PlacedShape& shape) const noexcept {
    return std::span(vertices_).subspan(shape.first_vertex, shape.vertex_count);
  }
  [[nodiscard]] std::span<const PlacedShape> shapes() const noexcept { return shapes_; }
  [[nodiscard]] const RobotState& robot(RobotId robot) const noexcept {
    return robots_[robot.value()];
  }
  /// By robot.
  [[nodiscard]] std::span<const RobotState> robots() const noexcept { return robots_; }
  /// Sine and cosine of a robot's yaw, computed once.
  [[nodiscard]] SinCos turn_WR(RobotId robot) const noexcept { return turns_[robot.value()]; }
  [[nodiscard]] const WorldModel& model() const noexcept { return *model_; }

  // WorldView.
  [[nodiscard]] SimTime time() const noexcept override { return time_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override;
  [[nodiscard]] BodyId body_of(RobotId robot) const noexcept override;
  [[nodiscard]] Pose2 pose(RobotId robot) const noexcept override;
  [[nodiscard]] Twist2 velocity_W(RobotId robot) const noexcept override;
  [[nodiscard]] Layer layer_of(BodyId body) const noexcept override;
  [[nodiscard]] std::span<const Landmark> landmarks() const noexcept override;
  [[nodiscard]] RayHit cast(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                            LayerMask layers, BodyId skip) const noexcept override;
  [[nodiscard]] bool visible(Vec2 p_from, Vec2 p_to, double z_m, LayerMask layers, BodyId a,
                             BodyId b) const noexcept override;
  [[nodiscard]] std::uint32_t robots_within(Vec2 p_W, double radius_m,
                                            std::span<RobotId> found) const noexcept override;
  [[nodiscard]] TouchState touch(RobotId robot) const noexcept override;

 private:
  struct Standing {
    Pose2 X_WB;
    bool present = true;
  };

  /// Moves the shapes and pieces of a body. Returns the square of the largest distance that a piece
  /// moved; infinite if it is not a number.
  double place(std::uint32_t body, const Body& description, Vec2 p_WB, SinCos turn, bool present);
  void place_outline(const PlacedShape& placed, const ConvexPolygon& polygon, Vec2 p_WB,
                     SinCos turn, bool present);
  void add_shapes(std::uint32_t body, const Body& description);
  /// Appends the end markers of the lists of shapes; reopen_shapes() removes them to add shapes.
  void end_shapes();
  void reopen_shapes();
  /// Creates the pieces, with the properties that do not depend on the pose.
  void make_pieces();
  void place_obstacle(std::uint32_t body);
  [[nodiscard]] std::uint32_t first_robot() const noexcept {
    return static_cast<std::uint32_t>(model_->obstacles.size());
  }
  [[nodiscard]] std::uint32_t first_added() const noexcept {
    return first_robot() + static_cast<std::uint32_t>(robots_.size());
  }
  /// The index of an obstacle in standing_.
  [[nodiscard]] std::size_t place_of(std::uint32_t body) const noexcept {
    return body < model_->obstacles.size() ? body : body - robots_.size();
  }
  void find_codes();
  void rebuild_landmarks();
  [[nodiscard]] RayHit nearest(Vec2 p_W, Vec2 direction, double z_m, double range_max_m,
                               LayerMask layers, BodyId a, BodyId b) const;

  const WorldModel* model_;
  SimTime time_;
  std::vector<PlacedShape> shapes_;
  std::vector<Vec2> vertices_;
  std::vector<std::uint32_t> first_shape_;  ///< Per body; one more at the end.
  std::vector<RobotState> robots_;
  std::vector<SinCos> turns_;       ///< Per robot.
  std::vector<Standing> standing_;  ///< Per obstacle.
  /// Pieces of obstacles to be sorted, if some were added.
  std::vector<ShapePiece> standing_pieces_;
  std::vector<TouchState> touch_;
  std::vector<Landmark> landmarks_;   ///< Landmarks of obstacles first.
  std::size_t fixed_landmarks_ = 0;   ///< Number of landmarks of obstacles.
  std::vector<std::uint32_t> coded_;  ///< Robots with a barcode.
  std::vector<Vec2> normals_;         ///< Normals of the edges that begin at vertices_.
  std::vector<Vec2> whole_;           ///< Per shape: centre of its bounding disc, body frame.
  std::vector<CoverDisc> cover_;
  std::vector<std::uint32_t> first_disc_;  ///< Per shape, in cover_; one more at the end.
  std::vector<ShapePiece> pieces_;         ///< One per disc of the cover, in the same order.
  double largest_robot_m_ = 0;
  double drift_m_ = 0;
  std::uint64_t generation_ = 0;
  ShapeGrid fixed_;
  ShapeGrid moving_;
};

}  // namespace rave::world
