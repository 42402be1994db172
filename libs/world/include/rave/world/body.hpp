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

/// One upright piece of a body: an outline in the plane, extended over a range of heights. The
/// prism is the first kind of shape; the list is open for others.
struct Shape {
  ShapeKind kind = ShapeKind::kDisc;
  std::optional<ConvexPolygon> polygon;  ///< Polygon: body frame.
  Vec2 centre;                           ///< Disc: body frame.
  double radius_m = 0;                   ///< Disc.
  double z0_m = 0;                       ///< Lowest height above the floor.
  double z1_m = 1;                       ///< Highest.

  /// Of a polygon, counter-clockwise; empty for a disc.
  [[nodiscard]] std::span<const Vec2> vertices() const noexcept {
    return polygon ? polygon->vertices() : std::span<const Vec2>();
  }
};

/// Checks and orders the vertices of a polygon: counter-clockwise, convex pieces. A simple polygon
/// that is not convex becomes several shapes. Errors: kInvalidArgument (self-crossing, fewer than
/// three distinct vertices, not finite, z1 <= z0).
[[nodiscard]] Result<std::vector<Shape>> make_prisms(std::span<const Vec2> outline, double z0_m,
                                                     double z1_m);
[[nodiscard]] Result<Shape> make_disc(Vec2 centre, double radius_m, double z0_m, double z1_m);

/// Something with a place: an obstacle or the body of a robot.
struct Body {
  std::string name;
  std::vector<Shape> shapes;
  Layer layer = Layer::kVirtualObstacles;
  std::optional<std::int32_t> code;  ///< What a landmark camera reads on it.
  double code_z0_m = 0;              ///< Height range of the printed code.
  double code_z1_m = 0;
  std::string colour;  ///< `#rrggbb`, or empty for the kind's own.

  /// Radius of the smallest disc about the body's origin that holds all shapes.
  [[nodiscard]] double radius_m() const noexcept;
};

/// The body with its outline scaled about its origin; heights stay. Errors: kInvalidArgument (too
/// small or too large for shapes to keep their corners).
[[nodiscard]] Result<Body> scaled(const Body& body, double factor);

/// An obstacle stands where its pose says.
struct Obstacle {
  Body body;
  Pose2 X_WB;
  bool removed = false;  ///< Stands nowhere any more; its number stays taken.
};

/// Which bodies there are, and where obstacles stand now. Poses of robots live in Snapshot. Robots
/// are in the order of their RobotId. Body ids: the obstacles of the start first, then the robots,
/// then obstacles that came while the run went. So an id stays what it is whatever is added or
/// removed, and none is given twice in a run.
struct WorldModel {
  std::vector<Obstacle> obstacles;  ///< Of the start; as many as ever while a run goes.
  std::vector<Body> robots;
  std::vector<Obstacle> added;  ///< Later, in the order in which they came.

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
  /// The obstacle of this id, a removed one too; null if it is a robot or nothing.
  [[nodiscard]] const Obstacle* obstacle(std::uint32_t id) const noexcept {
    if (id < obstacles.size()) return &obstacles[id];
    const std::size_t later = std::size_t{id} - obstacles.size() - robots.size();  // modulo 2^64
    return is_robot(id) || later >= added.size() ? nullptr : &added[later];
  }
  [[nodiscard]] Obstacle* obstacle(std::uint32_t id) noexcept {
    return const_cast<Obstacle*>(std::as_const(*this).obstacle(id));
  }
  /// The id of obstacle number `index`, those of the start first.
  [[nodiscard]] std::uint32_t obstacle_id(std::size_t index) const noexcept {
    return static_cast<std::uint32_t>(index < obstacles.size() ? index : index + robots.size());
  }
  [[nodiscard]] std::size_t obstacle_count() const noexcept {
    return obstacles.size() + added.size();
  }
};

}  // namespace rave::world
