// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/base/result.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"
#include "rave/world/layer.hpp"

namespace rave::world {

enum class ShapeKind : std::uint8_t {
  kPolygon,  ///< Convex, counter-clockwise.
  kDisc,
};

/// One upright prism of a body: an outline in the plane, extended over a range of heights.
struct Shape {
  ShapeKind kind = ShapeKind::kDisc;
  std::optional<ConvexPolygon> polygon;  ///< Polygon: body frame.
  Vec2 centre;                           ///< Disc: body frame.
  double radius_m = 0;                   ///< Disc.
  double z0_m = 0;                       ///< Lowest height above the floor.
  double z1_m = 1;                       ///< Highest.

  /// The vertices of a polygon, counter-clockwise; empty for a disc.
  [[nodiscard]] std::span<const Vec2> vertices() const noexcept {
    return polygon ? polygon->vertices() : std::span<const Vec2>();
  }
};

/// Makes prisms from a simple polygon. Vertices may be clockwise; a concave polygon becomes several
/// convex shapes. Errors: kInvalidArgument (self-crossing, fewer than three distinct vertices, not
/// finite, z1 <= z0).
[[nodiscard]] Result<std::vector<Shape>> make_prisms(std::span<const Vec2> outline, double z0_m,
                                                     double z1_m);
[[nodiscard]] Result<Shape> make_disc(Vec2 centre, double radius_m, double z0_m, double z1_m);

/// An obstacle or the body of a robot.
struct Body {
  std::string name;
  std::vector<Shape> shapes;
  Layer layer = Layer::kVirtualObstacles;
  std::optional<std::int32_t> code;  ///< The code that a landmark camera reads on it.
  double code_z0_m = 0;              ///< Height range of the printed code.
  double code_z1_m = 0;
  std::string colour;  ///< `#rrggbb`; empty: the colour of its kind.

  /// Radius of the smallest disc about the body's origin that contains all shapes.
  [[nodiscard]] double radius_m() const noexcept;
};

/// A copy of the body with its outline scaled about its origin; heights do not change. Errors:
/// kInvalidArgument (the scaled shapes are too small or too large).
[[nodiscard]] Result<Body> scaled(const Body& body, double factor);

/// A body at a fixed pose.
struct Obstacle {
  Body body;
  Pose2 X_WB;
  bool removed = false;  ///< Does not exist any more; its id is not reused.
};

/// All bodies, and the present poses of obstacles. Poses of robots are in Snapshot. Robots are in
/// the order of their RobotId. Body ids: the initial obstacles first, then the robots, then
/// obstacles added during the run. So an id never changes and is never reused in a run.
struct WorldModel {
  std::vector<Obstacle> obstacles;  ///< Initial obstacles; their number is constant during a run.
  std::vector<Body> robots;
  std::vector<Obstacle> added;  ///< Obstacles added during the run, in order.

  [[nodiscard]] std::uint32_t body_count() const noexcept {
    return static_cast<std::uint32_t>(obstacles.size() + robots.size() + added.size());
  }
  [[nodiscard]] const Body& body(std::uint32_t id) const noexcept {
    const Obstacle* const standing = obstacle(id);
    return standing != nullptr ? standing->body : robots[id - obstacles.size()];
  }
  [[nodiscard]] bool is_robot(std::uint32_t id) const noexcept {
    return id >= obstacles.size() && id - obstacles.size() < robots.size();
  }
  /// The obstacle with this id, also a removed one; null if the id is not an obstacle.
  [[nodiscard]] const Obstacle* obstacle(std::uint32_t id) const noexcept {
    if (id < obstacles.size()) return &obstacles[id];
    const std::size_t later = std::size_t{id} - obstacles.size() - robots.size();  // modulo 2^64
    return is_robot(id) || later >= added.size() ? nullptr : &added[later];
  }
  [[nodiscard]] Obstacle* obstacle(std::uint32_t id) noexcept {
    return const_cast<Obstacle*>(std::as_const(*this).obstacle(id));
  }
  /// The id of obstacle number `index`; the initial ones come first.
  [[nodiscard]] std::uint32_t obstacle_id(std::size_t index) const noexcept {
    return static_cast<std::uint32_t>(index < obstacles.size() ? index : index + robots.size());
  }
  [[nodiscard]] std::size_t obstacle_count() const noexcept {
    return obstacles.size() + added.size();
  }
};

}  // namespace rave::world
