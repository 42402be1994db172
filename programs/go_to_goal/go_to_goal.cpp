// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "obstacle_memory.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/ordered_way.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/pure_pursuit.hpp"
#include "rave/robot/steering.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("goal_x_m", "m", 0, -1e6, 1e6, "Goal in the world frame; ignored with `goals_m`."),
    number_param("goal_y_m", "m", 0, -1e6, 1e6, "Goal in the world frame; ignored with `goals_m`."),
    numbers_param("goals_m", "m", -1e6, 1e6, "Several goals in order: x, y, x, y, ..."),
    number_param("tolerance_m", "m", 0.15, 0.01, 100,
                 "Distance at which the goal counts as reached."),
    number_param("cruise_mps", "m/s", 0.4, 0.01, 10, "Largest speed."),
    number_param("turn_gain_per_s", "1/s", 2.0, 0.1, 100,
                 "Turning rate per radian of heading error."),
    number_param("max_turn_rate_radps", "rad/s", 1.5, 0.1, 10, "Largest turning rate."),
    number_param("margin_m", "m", 0.1, 0, 10, "Clearance beside the body."),
    number_param("look_m", "m", 1.0, 0.1, 2.5, "Distance ahead that must be free."),
    number_param("min_turn_radius_m", "m", 0, 0, 100,
                 "Radius of the narrowest curve of a car; 0: it turns on the spot."),
    number_param("patience_s", "s", 10, 0.1, 3600,
                 "Time without progress after which it follows the wall."),
};

/// Drives to its goals around obstacles. Where heading for the goal leads no nearer, it follows the
/// boundary until it is nearer to the goal than ever and sees the way free: the leave condition of
/// TangentBug (I. Kamon, E. Rivlin, E. Rimon, "A new range-sensor based globally convergent
/// navigation algorithm for mobile robots", ICRA 1996). Directions are chosen as in VFH+.
/// Goals and paths of people come first; when they are cancelled it continues with its own.
class GoToGoal final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath;

  Status start(const Setup& setup) override {
    const Params params = setup.params();
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    scan_ = Scan(setup);
    points_R_.reserve(ObstacleMemory::kSide * ObstacleMemory::kSide + Sectors::kCount);
    return parameters_changed(params);
  }

  /// New goals are driven to from the first one on; with the old ones it continues where it was.
  Status parameters_changed(const Params& params) override {
    RAVE_TRY_ASSIGN(std::vector<Vec2> goals_W, read_goals(params));
    if (goals_W != goals_W_) {
      goals_W_ = std::move(goals_W);
      current_ = 0;
      begin_goal();
    }
    look_m_ = params.number("look_m");
    steering_ = Steering(setup_->robot_radius_m() + params.number("margin_m"), look_m_);
    tolerance_m_ = params.number("tolerance_m");
    cruise_mps_ = params.number("cruise_mps");
    turn_gain_per_s_ = params.number("turn_gain_per_s");
    max_turn_rate_radps_ = params.number("max_turn_rate_radps");
    patience_ = from_seconds(params.number("patience_s"));
    if (params.number("min_turn_radius_m") == min_radius_m_) return {};
    min_radius_m_ = params.number("min_turn_radius_m");
    pursuit_ = PursuitOfCar(min_radius_m_);
    way_ = OrderedWay(min_radius_m_ == 0);
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    const PoseReading& pose = percepts.pose();
    const Pose2 X_WR{pose.x_m, pose.y_m, pose.yaw_rad};
    if (!(std::abs(pose.x_m) + std::abs(pose.y_m) < kFar_m) || !std::isfinite(pose.yaw_rad)) {
      commands.velocity(drive_, 0, 0);  // It does not know where it is.
      return;
    }
    scan_.update(percepts);
    if (scan_.is_old()) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    memory_.update(scan_, X_WR, percepts.now());
    points_R_.clear();
    memory_.append_to(points_R_, X_WR, look_m_ + 0.5);
    for (const RangeHit& hit : scan_.hits()) {
      if (hit.blind) points_R_.push_back(hit.p_R);
    }

    const std::optional<Vec2> goal_W = next_goal(percepts, X_WR, commands);
    if (!goal_W) return;
    const Vec2 goal_R = transform_back(X_WR, *goal_W);
    const FreeHeading way =
        side_ == 0 ? toward(goal_R, percepts.now()) : along_wall(goal_R, X_WR, percepts.now());
    drive(way, std::sqrt(squared_norm(goal_R)), commands);
  }

 private:
  static Result<std::vector<Vec2>> read_goals(const Params& params) {
    std::vector<Vec2> goals_W;
    const std::span<const double> list_m = params.numbers("goals_m");
    if (list_m.size() % 2 != 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "`goals_m` must hold x, y, x, y, ...; it has {} numbers", list_m.size());
    }
    for (std::size_t i = 0; i < list_m.size(); i += 2)
      goals_W.push_back({list_m[i], list_m[i + 1]});
    if (goals_W.empty()) goals_W.push_back({params.number("goal_x_m"), params.number("goal_y_m")});
    return goals_W;
  }

  /// Where to drive now, for people or for itself. None: `commands` has what to do instead.
  std::optional<Vec2> next_goal(const Percepts& percepts, const Pose2& X_WR, Commands& commands) {
    // A car cuts corners, instead of circling about points that it has missed.
    if (way_.update(percepts, commands, tolerance_m_, min_radius_m_)) begin_goal();
    switch (way_.state()) {
      case OrderedWay::State::kGoing:
        return way_.next();
      case OrderedWay::State::kTurning:
        commands.velocity(drive_, 0, way_.turn_radps(percepts.pose(), max_turn_rate_radps_));
        return std::nullopt;
      case OrderedWay::State::kThere:
        commands.velocity(drive_, 0, 0);
        return std::nullopt;
      case OrderedWay::State::kNone:
        break;
    }
    if (current_ < goals_W_.size()) arrive(X_WR, percepts.now());
    if (current_ < goals_W_.size()) return goals_W_[current_];
    commands.velocity(drive_, 0, 0);
    return std::nullopt;
  }

  /// Nothing is known of the way to the goal that comes now.
  void begin_goal() {
    side_ = 0;
    pursuit_.begin();
    nearest_m_ = kFar_m;
  }

  /// Takes the next goal when this one is reached.
  void arrive(const Pose2& X_WR, SimTime now) {
    const double distance_m = std::sqrt(squared_norm(goals_W_[current_] - X_WR.position()));
    if (distance_m > tolerance_m_) return;
    setup_->log(fmt::format("goal {} of {} reached at {:.2f} s", current_ + 1, goals_W_.size(),
                            now.seconds()));
    ++current_;
    begin_goal();
  }

  /// Heads for the goal; begins to follow the wall when that brings it no nearer.
  FreeHeading toward(Vec2 goal_R, SimTime now) {
    const double distance_m = std::sqrt(squared_norm(goal_R));
    // Less than 5 cm nearer is noise of the pose and no progress.
    if (distance_m < nearest_m_ - 0.05) {
      nearest_m_ = distance_m;
      nearer_at_ = now;
    }
    const double bearing_rad = atan2(goal_R.y, goal_R.x);
    const FreeHeading way = steering_.best(points_R_, bearing_rad, distance_m);
    const double detour_rad = wrap_angle(way.heading_rad - bearing_rad);
    const bool backward = std::abs(detour_rad) > deg_to_rad(90) || way.free_m < 0.05;
    if (!backward && now - nearer_at_ < patience_) return way;
    // The wall comes to lie on the side that the goal would have it pass: left detour, right hand.
    side_ = detour_rad >= 0 ? 1 : -1;
    follow_from_W_.reset();
    return way;
  }

  /// Keeps a hand on the wall: side 1 has it on the right, side -1 on the left.
  FreeHeading along_wall(Vec2 goal_R, const Pose2& X_WR, SimTime now) {
    const double distance_m = std::sqrt(squared_norm(goal_R));
    const double bearing_rad = atan2(goal_R.y, goal_R.x);
    const FreeHeading direct = steering_.best(points_R_, bearing_rad, distance_m);
    // The leave condition: nearer than ever, and the way is free. The margin keeps it from leaving
    // the wall where it met it.
    const bool nearer = distance_m < nearest_m_ - 0.2;
    const bool open = direct.free_m >= std::min(distance_m, look_m_) &&
                      std::abs(wrap_angle(direct.heading_rad - bearing_rad)) < deg_to_rad(60);
    if (nearer && open) {
      side_ = 0;
      nearest_m_ = distance_m;
      nearer_at_ = now;
    } else if (went_round(X_WR)) {
      // Once around without a way: what it remembers may be wrong, or the world has changed.
      setup_->log(way_.asked()
                      ? fmt::format("no path to the ordered goal found by {:.2f} s; trying again",
                                    now.seconds())
                      : fmt::format("no path to goal {} found by {:.2f} s; trying again",
                                    current_ + 1, now.seconds()));
      memory_.forget();
      side_ = 0;
      nearest_m_ = kFar_m;
      nearer_at_ = now;
    }
    if (side_ == 0) return direct;
    return steering_.first(points_R_, wall_bearing_rad(), side_, kFollowLook_m);
  }

  /// Where the wall is that it follows: the nearest remembered point on the side of its hand or
  /// ahead, so that the other wall of a corridor does not count; else the nearest of all.
  double wall_bearing_rad() const {
    double nearest_m2 = kFar_m;
    double bearing_rad = -side_ * deg_to_rad(90);
    for (const bool any_side : {false, true}) {
      for (const Vec2 p_R : points_R_) {
        if (squared_norm(p_R) >= nearest_m2) continue;
        const double angle_rad = atan2(p_R.y, p_R.x);
        if (!any_side && angle_rad * side_ > deg_to_rad(30)) continue;
        nearest_m2 = squared_norm(p_R);
        bearing_rad = angle_rad;
      }
      if (nearest_m2 < kFar_m) break;
    }
    return bearing_rad;
  }

  /// Whether it is back where it began to follow, after having been elsewhere.
  bool went_round(const Pose2& X_WR) {
    if (!follow_from_W_) {
      follow_from_W_ = X_WR.position();
      left_start_ = false;
    }
    const double from_start_m2 = squared_norm(X_WR.position() - *follow_from_W_);
    // Squares of distances: it has been 1 m away, and is back within 0.3 m.
    if (from_start_m2 > 1.0) left_start_ = true;
    return left_start_ && from_start_m2 < 0.3 * 0.3;
  }

  void drive(const FreeHeading& way, double distance_m, Commands& commands) {
    if (min_radius_m_ > 0) return drive_car(way, distance_m, commands);
    // Slower where it is narrow and near the goal; none while it still has to turn far.
    const double room = std::clamp(way.free_m / kFollowLook_m, 0.0, 1.0);
    const double turned = std::max(0.0, 1.0 - std::abs(way.heading_rad) / deg_to_rad(60));
    const double most_mps = way_.asked() ? way_.speed_mps(cruise_mps_) : cruise_mps_;
    const double v_mps = std::min(most_mps, distance_m) * room * turned;
    commands.velocity(drive_, v_mps,
                      std::clamp(turn_gain_per_s_ * way.heading_rad, -max_turn_rate_radps_,
                                 max_turn_rate_radps_));
  }

  /// To a point in the free direction, at most one look ahead.
  void drive_car(const FreeHeading& way, double distance_m, Commands& commands) {
    const double most_mps = way_.asked() ? way_.speed_mps(cruise_mps_) : cruise_mps_;
    const double behind_m = steering_.free_m(points_R_, kPi, kFollowLook_m);
    const SinCos heading = sincos(way.heading_rad);
    const double reach_m = std::min(distance_m, std::max(look_m_, 2 * min_radius_m_));
    PursuitOfCar::Velocity velocity =
        pursuit_.toward({reach_m * heading.cos, reach_m * heading.sin},
                        std::min(most_mps, distance_m), behind_m >= kFollowLook_m);
    // Slower where it is narrow, on the same curve; the chord of what it drives next counts, too.
    const double chord_m = steering_.free_m(points_R_, 0.5 * way.heading_rad, kFollowLook_m);
    double free_m = velocity.v_mps < 0 ? behind_m : std::min(way.free_m, chord_m);
    if (velocity.v_mps > 0 && free_m < kBump_m && behind_m >= kFollowLook_m) {
      const double side = way.heading_rad < 0 ? -1 : 1;
      velocity = {-velocity.v_mps, side * velocity.v_mps / min_radius_m_};
      free_m = behind_m;
    }
    const double room = std::clamp(free_m / kFollowLook_m, 0.0, 1.0);
    commands.velocity(drive_, room * velocity.v_mps, room * velocity.w_radps);
  }

  static constexpr double kFar_m = 1e9;
  static constexpr double kFollowLook_m = 0.4;
  static constexpr double kBump_m = 0.05;

  std::optional<Setup> setup_;
  ControllerHandle drive_;
  Scan scan_;
  ObstacleMemory memory_;
  Steering steering_;
  std::vector<Vec2> points_R_;
  std::vector<Vec2> goals_W_;
  double look_m_ = 0;
  double tolerance_m_ = 0;
  double cruise_mps_ = 0;
  double turn_gain_per_s_ = 0;
  double max_turn_rate_radps_ = 0;
  Duration patience_;
  double min_radius_m_ = 0;
  PursuitOfCar pursuit_;

  OrderedWay way_;
  std::size_t current_ = 0;    ///< Of the goals.
  int side_ = 0;               ///< 0: toward the goal; else along a wall.
  double nearest_m_ = kFar_m;  ///< To this goal so far, while heading for it.
  SimTime nearer_at_;          ///< When it last came nearer.
  std::optional<Vec2> follow_from_W_;
  bool left_start_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("go_to_goal") {
  rave::add_program<rave::GoToGoal>(
      registry, {.name = "go_to_goal",
                 .summary = "Drives to one or more goals, around obstacles and out of dead ends.",
                 .params = rave::kParams});
}
