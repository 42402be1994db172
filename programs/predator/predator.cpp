// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/scan.hpp"
#include "rave/robot/steering.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    integer_param("prey", -1, -1, 4'294'967'295, "Id of the robot to hunt; -1: the nearest one."),
    number_param("max_speed_mps", "m/s", 0.5, 0.01, 10, "Speed of the hunt."),
    number_param("turn_gain_per_s", "1/s", 3.0, 0.1, 100,
                 "Turning rate per radian of heading error."),
    number_param("max_turn_rate_radps", "rad/s", 2.0, 0.1, 10, "Largest turning rate."),
    number_param("capture_m", "m", 0.6, 0, 100, "Distance at which the prey is captured."),
    number_param("prey_radius_m", "m", 0.3, 0, 100,
                 "Range readings within this distance of the prey count as the prey."),
    number_param("margin_m", "m", 0.1, 0, 10, "Clearance beside the body."),
    number_param("look_m", "m", 1.0, 0.1, 100, "Distance ahead that must be free."),
};

/// Hunts another robot by aiming at the point where it can meet it, around obstacles.
class Predator final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    const Params params = setup.params();
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    RAVE_TRY_ASSIGN(eyes_, setup.sensor<NeighbourReading>());
    scan_ = Scan(setup);
    points_R_.reserve(1024);
    return parameters_changed(params);
  }

  Status parameters_changed(const Params& params) override {
    steering_ =
        Steering(setup_->robot_radius_m() + params.number("margin_m"), params.number("look_m"));
    prey_ = params.integer("prey");
    max_speed_mps_ = params.number("max_speed_mps");
    turn_gain_per_s_ = params.number("turn_gain_per_s");
    max_turn_rate_radps_ = params.number("max_turn_rate_radps");
    capture_m_ = params.number("capture_m");
    prey_radius_m_ = params.number("prey_radius_m");
    look_m_ = params.number("look_m");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    scan_.update(percepts);
    if (scan_.is_old() || percepts.is_old(eyes_)) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    const NeighbourReading* prey = find_prey(percepts[eyes_]);
    if (prey == nullptr) {
      commands.velocity(drive_, 0, 0.5 * max_turn_rate_radps_);  // Look around.
      return;
    }
    // From the sensor's frame into the robot's.
    const Pose2 X_RS = eyes_.info().X_RS;
    const SinCos bearing = sincos(static_cast<double>(prey->bearing_rad));
    const double range_m = static_cast<double>(prey->range_m);
    const Vec2 p_R = transform(X_RS, {range_m * bearing.cos, range_m * bearing.sin});
    // The sensor gives the velocity over ground, only turned into its axes.
    const Vec2 v_R =
        rotate(X_RS.yaw, {static_cast<double>(prey->vx_mps), static_cast<double>(prey->vy_mps)});

    const double distance_m = std::sqrt(squared_norm(p_R));
    if (distance_m <= capture_m_) {
      if (!captured_) {
        setup_->log(
            fmt::format("captured robot {} at {:.2f} s", prey->robot, percepts.now().seconds()));
      }
      captured_ = true;
      commands.velocity(drive_, 0, 0);
      return;
    }
    drive_to(p_R + meeting_time_s(p_R, v_R) * v_R, p_R, commands);
  }

 private:
  const NeighbourReading* find_prey(std::span<const NeighbourReading> seen) const {
    const NeighbourReading* found = nullptr;
    for (const NeighbourReading& reading : seen) {
      if (prey_ >= 0 && reading.robot != static_cast<std::uint32_t>(prey_)) continue;
      if (found == nullptr || reading.range_m < found->range_m) found = &reading;
    }
    return found;
  }

  /// The smallest t > 0 with |p + v t| = speed t: lead pursuit along a collision course
  /// (R. Isaacs, "Differential Games", Wiley 1965). A prey that cannot be met is aimed at a little
  /// ahead, so the hunt continues.
  double meeting_time_s(Vec2 p_R, Vec2 v_R) const {
    // |p + v t|^2 = s^2 t^2 is a t^2 - 2 b t - c = 0 with these a, b and c; its positive root is (b
    // + root) / a = c / (root - b).
    const double a = max_speed_mps_ * max_speed_mps_ - squared_norm(v_R);
    const double b = dot(p_R, v_R);
    const double c = squared_norm(p_R);
    const double root = b * b + a * c;
    if (root >= 0) {
      // 2 t = c / ..., in the form that stays exact when both are as fast (a = 0).
      const double divisor = std::sqrt(root) - b;
      if (divisor > 1e-9) return std::min(c / divisor, kLongestLead_s);
    }
    return kShortLead_s;
  }

  void drive_to(Vec2 aim_R, Vec2 prey_R, Commands& commands) {
    points_R_.clear();
    for (const RangeHit& hit : scan_.hits()) {
      // The prey itself must not count as an obstacle, or the hunt would steer around it.
      if (hit.blind || squared_norm(hit.p_R - prey_R) > prey_radius_m_ * prey_radius_m_) {
        points_R_.push_back(hit.p_R);
      }
    }
    const double aim_m = std::sqrt(squared_norm(aim_R));
    const FreeHeading way = steering_.best(points_R_, atan2(aim_R.y, aim_R.x), aim_m);
    // Slower where it is narrow, none while it still has to turn far.
    const double room = std::clamp(way.free_m / std::min(look_m_, std::max(aim_m, 0.01)), 0.0, 1.0);
    const double ahead = std::max(0.0, cos(way.heading_rad));
    commands.velocity(drive_, max_speed_mps_ * room * ahead,
                      std::clamp(turn_gain_per_s_ * way.heading_rad, -max_turn_rate_radps_,
                                 max_turn_rate_radps_));
  }

  static constexpr double kLongestLead_s = 10;
  static constexpr double kShortLead_s = 0.5;

  std::optional<Setup> setup_;
  ControllerHandle drive_;
  SensorHandle<NeighbourReading> eyes_;
  Scan scan_;
  Steering steering_;
  std::vector<Vec2> points_R_;
  std::int64_t prey_ = -1;
  double max_speed_mps_ = 0;
  double turn_gain_per_s_ = 0;
  double max_turn_rate_radps_ = 0;
  double capture_m_ = 0;
  double prey_radius_m_ = 0;
  double look_m_ = 0;
  bool captured_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("predator") {
  rave::add_program<rave::Predator>(
      registry, {.name = "predator",
                 .summary = "Hunts another robot, aiming at the point of interception.",
                 .params = rave::kParams});
}
