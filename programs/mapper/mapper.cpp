// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "rave/estimate/explorer.hpp"
#include "rave/estimate/robot_map.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/ordered_way.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/scan.hpp"
#include "rave/robot/steering.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("cruise_mps", "m/s", 0.25, 0.01, 10, "Largest speed."),
    number_param("turn_radps", "rad/s", 1.2, 0.1, 10, "Largest turning rate."),
    number_param("margin_m", "m", 0.04, 0, 10, "Clearance beside the body."),
    number_param("replan_s", "s", 1, 0.1, 60, "Time between two plans."),
    number_param("patience_s", "s", 30, 1, 3600, "Time after which it gives up a frontier."),
    bool_param("explores", true, "Whether it explores alone while no person gives it a goal."),
};

/// Keeps a map of what its range sensors see, and drives by it: to the goals of people, or else to
/// the nearest frontier of the map until it has seen all that it can reach.
class Mapper final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath;

  Status start(const Setup& setup) override {
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    sensors_ = setup.all_sensors<float>();
    for (const RangesHandle& sensor : sensors_) {
      if (sensor.info().bearings_rad == nullptr || sensor.info().capacity == 0) continue;
      longest_m_ = std::max(longest_m_, sensor.info().range_max_m);
    }
    if (!(longest_m_ > 0)) {
      return fail(ErrorCode::kInvalidArgument,
                  "it has no range sensor with known directions, of which it could make a map");
    }
    scan_ = Scan(setup);
    return parameters_changed(setup.params());
  }

  Status parameters_changed(const Params& params) override {
    cruise_mps_ = params.number("cruise_mps");
    turn_radps_ = params.number("turn_radps");
    replan_ = from_seconds(params.number("replan_s"));
    patience_ = from_seconds(params.number("patience_s"));
    explores_ = params.flag("explores");
    const double half_width_m = setup_->robot_radius_m() + params.number("margin_m");
    steering_ = Steering(half_width_m, kLook_m);
    explorer_ = estimate::Explorer({.clearance_m = half_width_m - 0.5 * kPlanCell_m + 0.05});
    return {};
  }

  [[nodiscard]] MapView map() const {
    if (!map_) return {};
    const estimate::GridFrame& frame = map_->grid().frame();
    return {frame.resolution_m,
            frame.origin_W,
            static_cast<std::uint32_t>(frame.columns),
            static_cast<std::uint32_t>(frame.rows),
            map_->grid().all_log_odds().data(),
            map_->grid().all_seen().data(),
            map_->touched().data(),
            map_->newest_ns()};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    const PoseReading& pose = percepts.pose();
    const Pose2 X_WR{pose.x_m, pose.y_m, pose.yaw_rad};
    if (!(std::abs(pose.x_m) + std::abs(pose.y_m) < 1e6) || !std::isfinite(pose.yaw_rad)) {
      commands.velocity(drive_, 0, 0);  // It does not know where it is.
      return;
    }
    learn(percepts, X_WR);
    commands.state(map_->grid().digest());
    if (way_.update(percepts, commands, kTolerance_m)) forget_plan();
    scan_.update(percepts);
    if (scan_.is_old() || percepts.is_driven()) {
      moved_at_ = percepts.now();
      commands.velocity(drive_, 0, 0);
      return;
    }
    if (way_.state() == OrderedWay::State::kTurning) {
      commands.velocity(drive_, 0, way_.turn_radps(pose, turn_radps_));
    } else if (way_.state() == OrderedWay::State::kThere || (!way_.asked() && !explores_)) {
      commands.velocity(drive_, 0, 0);
    } else if (!escapes(percepts, X_WR, commands)) {
      plan(percepts.now(), X_WR, commands);
      follow(X_WR, commands);
    }
  }

 private:
  static constexpr double kTolerance_m = 0.15;
  static constexpr double kLook_m = 0.5;
  static constexpr double kPlanCell_m = 0.2;
  static constexpr double kOccupied = 1.2;  ///< Log odds.
  static constexpr Duration kStuck = from_seconds(4);
  static constexpr Duration kBackOff = from_seconds(1.5);

  void learn(const Percepts& percepts, const Pose2& X_WR) {
    if (!map_) map_.emplace(X_WR.position(), longest_m_);
    map_->follow(percepts.now().ns, X_WR);
    for (std::size_t i = 0; i < sensors_.size(); ++i) {
      const SampleHeader& header = percepts.header(sensors_[i]);
      const SensorInfo& info = sensors_[i].info();
      if (header.fresh == 0 || info.bearings_rad == nullptr) continue;
      const std::size_t count = std::min(header.count, info.capacity);
      map_->add({static_cast<std::uint32_t>(i),
                 header.stamp_ns,
                 info.X_RS,
                 info.range_max_m,
                 info.cone_rad,
                 {info.bearings_rad, count},
                 percepts[sensors_[i]].first(count)});
    }
  }

  void forget_plan() {
    path_W_.clear();
    target_W_.reset();
    said_ = false;
    planned_ = {};
  }

  void plan(SimTime now, const Pose2& X_WR, Commands& commands) {
    const bool there = target_W_ && squared_norm(*target_W_ - X_WR.position()) < 0.3 * 0.3;
    const bool late = target_W_ && now - chosen_ > patience_;
    if (!way_.asked() && (there || late)) {
      // Seen from as near as this, what is still unknown there will stay so.
      explorer_.give_up(map_->grid(), *target_W_, 0.3);
      target_W_.reset();
    } else if (planned_ && now - *planned_ < replan_) {
      return;
    }
    planned_ = now;
    if (way_.asked()) {
      if (!explorer_.to_goal(map_->grid(), X_WR.position(), way_.next(), path_W_) && !said_) {
        said_ = commands.say("I see no way to the goal.");
      }
      return;
    }
    const std::optional<Vec2> before = target_W_;
    if (explorer_.to_frontier(map_->grid(), X_WR.position(), target_W_, path_W_)) {
      target_W_ = path_W_.back();
    } else {
      target_W_.reset();
      if (!said_) said_ = commands.say("I have explored all that I can reach.");
    }
    const bool same = before && target_W_ && squared_norm(*before - *target_W_) < 1e-12;
    if (!same) chosen_ = now;
  }

  /// Drives along the plan, around what the map has near.
  void follow(const Pose2& X_WR, Commands& commands) {
    if (path_W_.empty()) {
      commands.velocity(drive_, 0, 0);
      return;
    }
    const Vec2 aim_R = transform_back(X_WR, aim_at(X_WR.position()));
    const double distance_m = std::sqrt(squared_norm(aim_R));
    gather_points(X_WR);
    const FreeHeading way =
        steering_.best(points_R_, atan2(aim_R.y, aim_R.x), std::min(distance_m, kLook_m));
    const double ahead_m = scan_.nearest_m(-0.5, 0.5) - setup_->robot_radius_m();
    const double room = std::clamp((std::min(ahead_m, way.free_m) - 0.03) / 0.3, 0.0, 1.0);
    const double turned = std::max(0.0, 1 - std::abs(way.heading_rad) / deg_to_rad(60));
    const double most_mps = way_.asked() ? way_.speed_mps(cruise_mps_) : cruise_mps_;
    commands.velocity(drive_, std::min(most_mps, distance_m) * room * turned,
                      std::clamp(2 * way.heading_rad, -turn_radps_, turn_radps_));
  }

  /// The last point of the path that is near enough to head for directly.
  [[nodiscard]] Vec2 aim_at(Vec2 p_WR) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < path_W_.size(); ++i) {
      if (squared_norm(path_W_[i] - p_WR) < squared_norm(path_W_[nearest] - p_WR)) nearest = i;
    }
    std::size_t aim = nearest;
    while (aim + 1 < path_W_.size() && squared_norm(path_W_[aim] - p_WR) < 0.35 * 0.35) ++aim;
    return path_W_[aim];
  }

  void gather_points(const Pose2& X_WR) {
    points_R_.clear();
    const estimate::GridFrame& frame = map_->grid().frame();
    const double reach_m = kLook_m + 0.25;
    const auto cell = [&](double at, double origin, int cells) {
      return static_cast<int>(std::clamp(std::floor((at - origin) / frame.resolution_m), 0.0,
                                         static_cast<double>(cells - 1)));
    };
    const int last_row = cell(X_WR.y + reach_m, frame.origin_W.y, frame.rows);
    const int last_column = cell(X_WR.x + reach_m, frame.origin_W.x, frame.columns);
    for (int row = cell(X_WR.y - reach_m, frame.origin_W.y, frame.rows); row <= last_row; ++row) {
      for (int column = cell(X_WR.x - reach_m, frame.origin_W.x, frame.columns);
           column <= last_column; ++column) {
        if (map_->grid().log_odds(column, row) <= kOccupied) continue;
        points_R_.push_back(
            transform_back(X_WR, {frame.origin_W.x + (column + 0.5) * frame.resolution_m,
                                  frame.origin_W.y + (row + 0.5) * frame.resolution_m}));
      }
    }
  }

  /// Whether it gets itself out of a place where it makes no progress: backwards, while that is
  /// free, turning to a side by chance.
  bool escapes(const Percepts& percepts, const Pose2& X_WR, Commands& commands) {
    const SimTime now = percepts.now();
    if (squared_norm(X_WR.position() - moved_W_) > 0.1 * 0.1 || path_W_.empty()) {
      moved_W_ = X_WR.position();
      moved_at_ = now;
    }
    if (now - moved_at_ > kStuck) {
      moved_at_ = now;
      escape_until_ = now + kBackOff;
      side_ = percepts.random().bits() % 2 == 0 ? 1 : -1;
      if (target_W_) explorer_.give_up(map_->grid(), *target_W_, 0.3);
      forget_plan();
    }
    if (now >= escape_until_) return false;
    const double behind_m =
        std::min(scan_.nearest_m(kPi - 0.6, kPi), scan_.nearest_m(-kPi, 0.6 - kPi));
    const bool free = behind_m - setup_->robot_radius_m() > 0.05;
    commands.velocity(drive_, free ? -0.4 * cruise_mps_ : 0, side_ * 0.7 * turn_radps_);
    return true;
  }

  std::optional<Setup> setup_;
  ControllerHandle drive_;
  std::vector<RangesHandle> sensors_;
  double longest_m_ = 0;
  std::optional<estimate::RobotMap> map_;
  estimate::Explorer explorer_;
  Scan scan_;
  Steering steering_;
  OrderedWay way_;
  double cruise_mps_ = 0;
  double turn_radps_ = 0;
  Duration replan_;
  Duration patience_;
  bool explores_ = true;

  std::vector<Vec2> path_W_;
  std::optional<Vec2> target_W_;  ///< The frontier that it heads for.
  std::optional<SimTime> planned_;
  SimTime chosen_;  ///< When it chose the frontier.
  bool said_ = false;
  std::vector<Vec2> points_R_;
  Vec2 moved_W_;
  SimTime moved_at_;
  SimTime escape_until_;
  int side_ = 1;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("mapper") {
  rave::add_program<rave::Mapper>(
      registry, {.name = "mapper",
                 .summary = "Maps its surroundings; drives to goals, or explores what is unknown.",
                 .params = rave::kParams});
}
