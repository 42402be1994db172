// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "programs/testing/program_harness.hpp"
#include "rave/math/transform.hpp"

namespace rave::testing {

/// A straight wall, world frame.
struct Wall {
  Vec2 from_W;
  Vec2 to_W;
};

/// Another robot as a room sees it, world frame.
struct Disc {
  Vec2 p_W;
  double radius_m = 0;
};

/// Walls and discs whose geometry is simple enough to be right at sight.
class Room {
 public:
  Room& wall(Vec2 from_W, Vec2 to_W) {
    walls_.push_back({from_W, to_W});
    return *this;
  }
  Room& box(double x0_m, double y0_m, double x1_m, double y1_m) {
    return wall({x0_m, y0_m}, {x1_m, y0_m})
        .wall({x1_m, y0_m}, {x1_m, y1_m})
        .wall({x1_m, y1_m}, {x0_m, y1_m})
        .wall({x0_m, y1_m}, {x0_m, y0_m});
  }

  /// Distance from the nearest wall.
  [[nodiscard]] double distance_m(Vec2 p_W) const {
    double nearest_m2 = std::numeric_limits<double>::infinity();
    for (const Wall& w : walls_) {
      const Vec2 along = w.to_W - w.from_W;
      const double share = std::clamp(dot(p_W - w.from_W, along) / squared_norm(along), 0.0, 1.0);
      nearest_m2 = std::min(nearest_m2, squared_norm(p_W - (w.from_W + share * along)));
    }
    return std::sqrt(nearest_m2);
  }

  [[nodiscard]] double ray_m(Vec2 p_W, double angle_rad, const std::vector<Disc>& discs) const {
    const SinCos angle = sincos(angle_rad);
    const Vec2 u{angle.cos, angle.sin};
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Wall& w : walls_) {
      const Vec2 along = w.to_W - w.from_W;
      const double divisor = cross(u, along);
      if (divisor == 0) continue;
      const double t = cross(w.from_W - p_W, along) / divisor;
      const double s = cross(w.from_W - p_W, u) / divisor;
      if (t >= 0 && s >= 0 && s <= 1) nearest_m = std::min(nearest_m, t);
    }
    for (const Disc& disc : discs) {
      const double b = dot(disc.p_W - p_W, u);
      const double root = b * b - squared_norm(disc.p_W - p_W) + disc.radius_m * disc.radius_m;
      if (root >= 0 && b > std::sqrt(root)) nearest_m = std::min(nearest_m, b - std::sqrt(root));
    }
    return nearest_m;
  }

  /// Gives every range sensor of `rig` its sample: rays, or cones as fans of eleven rays.
  void sense(Rig& rig, SimTime now, const std::vector<Disc>& discs = {}) const {
    for (RigSensor& sensor : rig.sensors) {
      if (sensor.info.kind != ReadingKind::kRanges) continue;
      const Pose2 X_WS = compose({rig.pose.x_m, rig.pose.y_m, rig.pose.yaw_rad}, sensor.info.X_RS);
      std::vector<float> ranges_m;
      for (const double bearing_rad : sensor.bearings_rad) {
        const int fan = sensor.info.cone_rad > 0 ? 11 : 1;
        double range_m = std::numeric_limits<double>::infinity();
        for (int k = 0; k < fan; ++k) {
          const double off_rad =
              fan == 1 ? 0.0 : sensor.info.cone_rad * (k / static_cast<double>(fan - 1) - 0.5);
          range_m =
              std::min(range_m, ray_m(X_WS.position(), X_WS.yaw + bearing_rad + off_rad, discs));
        }
        ranges_m.push_back(range_m > sensor.info.range_max_m
                               ? std::numeric_limits<float>::infinity()
                               : static_cast<float>(range_m));
      }
      sensor.give(ranges_m, now.ns);
    }
  }

 private:
  std::vector<Wall> walls_;
};

/// Moves a robot as its last velocity command says.
inline void move(Rig& rig, double dt_s) {
  const Command& command = rig.command();
  const Pose2 moved = integrate({rig.pose.x_m, rig.pose.y_m, rig.pose.yaw_rad},
                                {command.value[0], 0, command.value[1]}, dt_s);
  rig.pose.x_m = moved.x;
  rig.pose.y_m = moved.y;
  rig.pose.yaw_rad = moved.yaw;
}

/// The range sensors that a program must cope with.
enum class Suite { kThreeSonars, kEightSonars, kSixteenSonars, kLaser };
inline constexpr Suite kSuites[] = {Suite::kThreeSonars, Suite::kEightSonars, Suite::kSixteenSonars,
                                    Suite::kLaser};

inline void add_suite(Rig& rig, Suite suite) {
  std::vector<double> bearings_rad;
  switch (suite) {
    case Suite::kThreeSonars:
      for (const double b : {40.0, 0.0, -40.0}) bearings_rad.push_back(deg_to_rad(b));
      break;
    case Suite::kEightSonars:
      for (const double b : {90.0, 50.0, 30.0, 10.0, -10.0, -30.0, -50.0, -90.0}) {
        bearings_rad.push_back(deg_to_rad(b));
      }
      break;
    case Suite::kSixteenSonars:
      for (int k = 0; k < 16; ++k) bearings_rad.push_back(wrap_angle(deg_to_rad(22.5 * k)));
      break;
    case Suite::kLaser:
      for (int k = 0; k < 180; ++k) bearings_rad.push_back(deg_to_rad(-89.5 + k));
      rig.add_ranges(bearings_rad, 0, 8.0);
      return;
  }
  rig.add_ranges(bearings_rad, deg_to_rad(30), 4.0);
}

}  // namespace rave::testing
