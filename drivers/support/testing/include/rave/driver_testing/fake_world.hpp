// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rave/math/transform.hpp"
#include "rave/world/world_view.hpp"

namespace rave::testing {

/// A disc or a box in the fake world. For a robot, X_WB is the robot's pose.
struct FakeBody {
  Layer layer = Layer::kVirtualObstacles;
  Pose2 X_WB;
  double radius_m = 0;        ///< Radius of a disc; 0 for a box.
  Vec2 half_size_m = {0, 0};  ///< Half the lengths of a box along its own axes.
  double z0_m = 0;
  double z1_m = 1;
  RobotId robot = {};  ///< Valid for the body of a robot.
  Twist2 velocity_W = {};
  TouchState touch = {};
};

/// A world of few bodies for tests of drivers. Each query is a loop over textbook formulas. Bodies
/// keep the order in which they were added; robots are numbered.
class FakeWorld final : public WorldView {
 public:
  BodyId add_disc(Vec2 p_WB, double radius_m, Layer layer = Layer::kVirtualObstacles) {
    FakeBody body;
    body.layer = layer;
    body.X_WB = {p_WB.x, p_WB.y, 0};
    body.radius_m = radius_m;
    return add(body);
  }
  BodyId add_box(const Pose2& X_WB, Vec2 half_size_m, Layer layer = Layer::kVirtualObstacles) {
    FakeBody body;
    body.layer = layer;
    body.X_WB = X_WB;
    body.half_size_m = half_size_m;
    return add(body);
  }
  RobotId add_robot(const Pose2& X_WR, double radius_m, Layer layer = Layer::kSimulatedRobots) {
    FakeBody body;
    body.layer = layer;
    body.X_WB = X_WR;
    body.radius_m = radius_m;
    body.robot = RobotId(static_cast<std::uint32_t>(robots_.size()));
    robots_.push_back(add(body));
    return body.robot;
  }
  /// Puts a barcode on a body, between two heights.
  void add_code(BodyId body, std::int32_t code, double z0_m, double z1_m) {
    const FakeBody& carrier = at(body);
    landmarks_.push_back({body, code, carrier.X_WB.position(), z0_m, z1_m, carrier.robot});
  }
  void set_time(SimTime time) noexcept { time_ = time; }
  [[nodiscard]] FakeBody& at(BodyId body) { return bodies_[body.value()]; }
  [[nodiscard]] FakeBody& at(RobotId robot) { return at(robots_[robot.value()]); }

  [[nodiscard]] SimTime time() const noexcept override { return time_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override {
    return static_cast<std::uint32_t>(robots_.size());
  }
  [[nodiscard]] BodyId body_of(RobotId robot) const noexcept override {
    return robots_[robot.value()];
  }
  [[nodiscard]] Pose2 pose(RobotId robot) const noexcept override { return of(robot).X_WB; }
  [[nodiscard]] Twist2 velocity_W(RobotId robot) const noexcept override {
    return of(robot).velocity_W;
  }
  [[nodiscard]] Layer layer_of(BodyId body) const noexcept override {
    return bodies_[body.value()].layer;
  }
  [[nodiscard]] std::span<const Landmark> landmarks() const noexcept override { return landmarks_; }
  [[nodiscard]] TouchState touch(RobotId robot) const noexcept override { return of(robot).touch; }

  [[nodiscard]] RayHit cast(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                            LayerMask layers, BodyId skip) const noexcept override {
    return nearest(p_W, z_m, bearing_rad, range_max_m, layers, skip, skip);
  }
  [[nodiscard]] bool visible(Vec2 p_from, Vec2 p_to, double z_m, LayerMask layers, BodyId a,
                             BodyId b) const noexcept override {
    const Vec2 apart = p_to - p_from;
    const double distance_m = std::sqrt(squared_norm(apart));
    return !nearest(p_from, z_m, atan2(apart.y, apart.x), distance_m, layers, a, b).body.valid();
  }
  [[nodiscard]] std::uint32_t robots_within(Vec2 p_W, double radius_m,
                                            std::span<RobotId> found) const noexcept override {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < robot_count(); ++i) {
      const Vec2 apart = of(RobotId(i)).X_WB.position() - p_W;
      if (squared_norm(apart) > radius_m * radius_m) continue;
      if (count < found.size()) found[count] = RobotId(i);
      ++count;
    }
    return count;
  }

 private:
  BodyId add(const FakeBody& body) {
    bodies_.push_back(body);
    return BodyId(static_cast<std::uint32_t>(bodies_.size() - 1));
  }
  [[nodiscard]] const FakeBody& of(RobotId robot) const noexcept {
    return bodies_[robots_[robot.value()].value()];
  }

  [[nodiscard]] RayHit nearest(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                               LayerMask layers, BodyId a, BodyId b) const noexcept {
    RayHit best;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      const FakeBody& body = bodies_[i];
      if (BodyId(i) == a || BodyId(i) == b || !contains(layers, body.layer) || z_m < body.z0_m ||
          z_m > body.z1_m) {
        continue;
      }
      const Vec2 origin_B = transform_back(body.X_WB, p_W);
      const SinCos turn = sincos(bearing_rad - body.X_WB.yaw);
      const Vec2 direction_B{turn.cos, turn.sin};
      const double range_m = body.radius_m > 0 ? to_disc(origin_B, direction_B, body.radius_m)
                                               : to_box(origin_B, direction_B, body.half_size_m);
      if (range_m <= range_max_m && range_m < best.range_m) best = {range_m, BodyId(i)};
    }
    return best;
  }

  /// The smaller root of |o + t d| = r; 0 from inside.
  [[nodiscard]] static double to_disc(Vec2 origin, Vec2 direction, double radius_m) noexcept {
    const double c = squared_norm(origin) - radius_m * radius_m;
    if (c <= 0) return 0;
    const double b = dot(origin, direction);
    const double discriminant = b * b - c;
    if (b >= 0 || discriminant < 0) return kNoHit;
    return -b - std::sqrt(discriminant);
  }

  /// The slab method: the part of the ray that is between both pairs of sides.
  [[nodiscard]] static double to_box(Vec2 origin, Vec2 direction, Vec2 half) noexcept {
    double enter = 0;
    double leave = kNoHit;
    const auto slab = [&](double o, double d, double h) {
      if (d == 0) {
        if (std::abs(o) > h) leave = -1;
        return;
      }
      const double t0 = (-h - o) / d;
      const double t1 = (h - o) / d;
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    };
    slab(origin.x, direction.x, half.x);
    slab(origin.y, direction.y, half.y);
    return enter <= leave ? enter : kNoHit;
  }

  static constexpr double kNoHit = std::numeric_limits<double>::infinity();
  SimTime time_;
  std::vector<FakeBody> bodies_;
  std::vector<BodyId> robots_;
  std::vector<Landmark> landmarks_;
};

}  // namespace rave::testing
