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

/// Where a robot is at one instant, as others sense it.
struct RobotState {
  Pose2 X_WR;
  Twist2 velocity_W;     ///< Of the origin over ground, axes of W.
  bool present = false;  ///< False before the first pose of a real robot: nobody senses it.
};

/// A long ray, cut into parts that grow, so that what lies behind the first hit is hardly looked
/// for.
struct RayParts {
  double from_m = 0;
  double to_m = 0;
  double step_m = 1;  ///< Length of the next part.
  double end_m = 0;   ///< Behind this lies nothing.
  bool begun = false;

  /// On to the next part; false if there is none. There is always a first one.
  [[nodiscard]] bool next() noexcept {
    if (begun && !(to_m < end_m)) return false;
    begun = true;
    from_m = to_m;
    to_m = std::min(to_m + step_m, end_m);
    step_m *= 2;
    return true;
  }
};

/// The world at one instant, ready for queries. Set the robots, then rebuild(), then look at it
/// from as many threads as you like until the next set_robot(). No allocation after the first
/// rebuild() of a world, unless its obstacles change. Keeps a pointer to the model, which must
/// outlive it. Obstacles begin where the model has them; from then on they are where set_obstacle()
/// puts them, so that a snapshot of the past can show them where they stood.
class Snapshot final : public WorldView {
 public:
  explicit Snapshot(const WorldModel& model);

  void set_time(SimTime time) noexcept { time_ = time; }
  void set_robot(RobotId robot, const RobotState& state) noexcept;
  /// The same for who has `turn`, which must be sincos(state.X_WR.yaw), already.
  void set_robot(RobotId robot, const RobotState& state, SinCos turn) noexcept {
    robots_[robot.value()] = state;
    turns_[robot.value()] = turn;
  }
  void set_touch(RobotId robot, const TouchState& touch) noexcept;
  /// The model has another body of this robot, with as many shapes and corners as before; it counts
  /// from the next rebuild() on.
  void body_changed(RobotId robot);
  /// The model has one more obstacle, the last of WorldModel::added. It is nowhere yet.
  void obstacle_added();
  /// The model has none but the obstacles of the start any more; these stay where they are.
  void added_dropped();
  /// An obstacle is at another place, or nowhere: seen from the next index_obstacles() on.
  void set_obstacle(BodyId obstacle, const Pose2& X_WB, bool present);
  /// Sorts what stands into its grid; generation() changes. As rebuild(), not while others look.
  void index_obstacles();
  /// Where an obstacle is, or was before it went.
  [[nodiscard]] Pose2 obstacle_pose(BodyId obstacle) const noexcept {
    return standing_[place_of(obstacle.value())].X_WB;
  }
  [[nodiscard]] bool obstacle_present(BodyId obstacle) const noexcept {
    return standing_[place_of(obstacle.value())].present;
  }

  /// Moves all shapes of robots to their places and sorts them into the grid.
  void rebuild();
  /// rebuild() in parts: moves the shapes of robots [first, last) to their places and returns how
  /// far the farthest piece went, in metres. Several threads may set and place robots at once, as
  /// long as no two have the same robot; then one calls index_robots() with the largest of these
  /// distances, and only then may anybody look again.
  double place_robots(std::uint32_t first, std::uint32_t last);
  void index_robots(double farthest_m);

  /// For who keeps what it found near for later: since then no piece of a robot has moved by more
  /// than what drift_m() has grown by, if generation() is the same. The generation changes when a
  /// robot appears, vanishes, jumps by more than a metre, or gets another body, and when obstacles
  /// change.
  [[nodiscard]] double drift_m() const noexcept { return drift_m_; }
  [[nodiscard]] std::uint64_t generation() const noexcept { return generation_; }

  /// Shapes whose bounding disc comes within `radius_m` of a point, ascending and without
  /// repetition, put into `found` (its former content is dropped).
  void gather(Vec2 p_W, double radius_m, std::vector<std::uint32_t>& found) const;

  /// Calls `visit(piece)` for each piece of a shape that comes within `radius_m` of a point; a
  /// shape of several pieces may come several times. The order is the same in every run.
  template <class Visit>
  void for_each_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    for_each_standing_near(p_W, radius_m, visit);
    for_each_robot_near(p_W, radius_m, visit);
  }
  /// The same for the pieces of obstacles alone, and for those of robots.
  template <class Visit>
  void for_each_standing_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    fixed_.for_each_near(p_W, radius_m, visit);
  }
  template <class Visit>
  void for_each_robot_near(Vec2 p_W, double radius_m, Visit&& visit) const {
    moving_.for_each_near(p_W, radius_m, visit);
  }
  /// Calls `visit(piece)` for each piece of a shape that comes within `width_m` of a part of a ray;
  /// as for_each_near(), and see ShapeGrid::for_each_along().
  template <class Visit>
  void for_each_along(Vec2 p_W, Vec2 direction, double from_m, double to_m, double width_m,
                      Visit&& visit) const {
    fixed_.for_each_along(p_W, direction, from_m, to_m, width_m, visit);
    moving_.for_each_along(p_W, direction, from_m, to_m, width_m, visit);
  }
  /// How long the first part of a ray should be, in metres: as long as a ray goes on average until
  /// it comes to something.
  [[nodiscard]] double first_part_m() const noexcept;
  /// The parts in which to look along a ray that begins at p_W.
  [[nodiscard]] RayParts parts_of(Vec2 p_W, double range_max_m) const noexcept;
  /// The pieces of obstacles, and those of robots, for queries of their own.
  [[nodiscard]] const ShapeGrid& standing() const noexcept { return fixed_; }
  [[nodiscard]] const ShapeGrid& moving() const noexcept { return moving_; }
  /// All vertices, and the outward unit normal of the edge from each to the next of its shape;
  /// pieces say where theirs begin. kVertexPadding more follow.
  [[nodiscard]] const Vec2* vertices_W() const noexcept { return vertices_.data(); }
  [[nodiscard]] const Vec2* normals_W() const noexcept { return normals_.data(); }

  /// All pieces, each at its ShapePiece::index, which stays while the generation does. Those of who
  /// is not in the world lie where no query reaches.
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
  /// Sine and cosine of a robot's yaw: computed once for all who turn something by it.
  [[nodiscard]] SinCos turn_WR(RobotId robot) const noexcept { return turns_[robot.value()]; }
  [[nodiscard]] const WorldModel& model() const noexcept { return *model_; }

  // WorldView
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

  /// Moves the shapes of a body and its pieces; returns the square of how far the farthest went,
  /// infinite if that is no number.
  double place(std::uint32_t body, const Body& description, Vec2 p_WB, SinCos turn, bool present);
  void place_outline(const PlacedShape& placed, const ConvexPolygon& polygon, Vec2 p_WB,
                     SinCos turn, bool present);
  void add_shapes(std::uint32_t body, const Body& description);
  /// What ends the lists of shapes, and goes away while shapes are added.
  void end_shapes();
  void reopen_shapes();
  /// The pieces as far as they do not change with the place.
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
  std::vector<SinCos> turns_;                ///< Per robot.
  std::vector<Standing> standing_;           ///< Per obstacle.
  std::vector<ShapePiece> standing_pieces_;  ///< To be sorted, if some were added.
  std::vector<TouchState> touch_;
  std::vector<Landmark> landmarks_;   ///< Those of obstacles first.
  std::size_t fixed_landmarks_ = 0;   ///< How many those are.
  std::vector<std::uint32_t> coded_;  ///< Robots that carry a code.
  std::vector<Vec2> normals_;         ///< Of the edges that begin at vertices_.
  std::vector<Vec2> whole_;           ///< Per shape: middle of its bounding disc, body frame.
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
