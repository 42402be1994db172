// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/ordered_way.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/scan.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("cruise_mps", "m/s", 0.3, 0, 10, "Speed while nothing is near."),
    number_param("avoid_m", "m", 0.6, 0, 100, "Distance from its body below which it turns."),
    number_param("stop_m", "m", 0.15, 0, 100, "Distance below which it turns on the spot."),
    number_param("turn_radps", "rad/s", 1.0, 0.01, 10, "Turning rate while avoiding."),
    number_param("front_deg", "deg", 70, 1, 180, "Half of the angle that counts as ahead."),
    integer_param("turn_decisions_min", 3, 1, 10'000, "Shortest turn, in decisions."),
    integer_param("turn_decisions_max", 15, 1, 10'000, "Longest turn, in decisions."),
    number_param("back_off_s", "s", 0, 0, 100, "Time to reverse before it turns away; 0: never."),
    number_param("rear_stop_m", "m", 0.25, 0, 100,
                 "Distance behind it below which it stops reversing."),
    number_param("rear_deg", "deg", 45, 1, 180, "Half of the angle that counts as behind."),
    number_param("centre_x_m", "m", 0, -1e6, 1e6, "Middle of the area to stay in, world frame."),
    number_param("centre_y_m", "m", 0, -1e6, 1e6, "Middle of the area to stay in, world frame."),
    number_param("stay_within_m", "m", 0, 0, 1e6, "Radius of that area; 0: no limit."),
};

/// Drives ahead; turns away from whatever comes near, to the freer side, for a random time.
/// Asked by people it heads for their goals instead of straight ahead.
class Wander final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath;

  Status start(const Setup& setup) override {
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    scan_ = Scan(setup);
    return parameters_changed(setup.params());
  }

  Status parameters_changed(const Params& params) override {
    const double stop_m = params.number("stop_m");
    const double avoid_m = params.number("avoid_m");
    if (stop_m >= avoid_m) {
      return fail(ErrorCode::kInvalidArgument, "`stop_m` ({}) must be less than `avoid_m` ({})",
                  stop_m, avoid_m);
    }
    radius_m_ = setup_->robot_radius_m();
    cruise_mps_ = params.number("cruise_mps");
    avoid_m_ = avoid_m;
    stop_m_ = stop_m;
    turn_radps_ = params.number("turn_radps");
    front_rad_ = deg_to_rad(params.number("front_deg"));
    shortest_turn_ = params.integer("turn_decisions_min");
    longest_turn_ = std::max(shortest_turn_, params.integer("turn_decisions_max"));
    rear_stop_m_ = params.number("rear_stop_m");
    rear_rad_ = deg_to_rad(params.number("rear_deg"));
    longest_back_off_ = std::llround(params.number("back_off_s") / setup_->period_s());
    centre_W_ = {params.number("centre_x_m"), params.number("centre_y_m")};
    stay_within_m_ = params.number("stay_within_m");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    if (way_.asked() || !percepts.orders().empty()) way_.update(percepts, commands, kTolerance_m);
    scan_.update(percepts);
    if (scan_.is_old()) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    if (way_.asked() && way_.state() != OrderedWay::State::kGoing) {
      const bool turns = way_.state() == OrderedWay::State::kTurning;
      commands.velocity(drive_, 0, turns ? way_.turn_radps(percepts.pose(), turn_radps_) : 0);
      return;
    }
    // From the body and not from the centre, so one set of parameters fits robots of all sizes.
    const double clearance_m = scan_.nearest_m(-front_rad_, front_rad_) - radius_m_;
    const int home = way_.asked() ? 0 : way_home(percepts.pose());
    const bool must_turn = clearance_m < avoid_m_ || home != 0;

    if (turns_left_ == 0 && must_turn) {
      // Still blocked after a turn: continue the same way round, or a corner would trap it.
      if (!turning_) side_ = home != 0 ? home : freer_side(percepts);
      turns_left_ = turn_length(percepts);
      if (!turning_ && clearance_m < avoid_m_) back_off_left_ = longest_back_off_;
    }
    if (backs_off()) {
      commands.velocity(drive_, -0.5 * cruise_mps_, 0);
      return;
    }
    turning_ = turns_left_ > 0;
    if (turning_) --turns_left_;

    // Full speed at avoid_m, none at stop_m: a disc that only turns cannot hit anything.
    const double share = std::clamp((clearance_m - stop_m_) / (avoid_m_ - stop_m_), 0.0, 1.0);
    if (way_.asked() && !turning_) return head_for(way_.next(), percepts.pose(), share, commands);
    const double most_mps = turning_ ? 0.5 * cruise_mps_ : cruise_mps_;
    commands.velocity(drive_, most_mps * share, turning_ ? side_ * turn_radps_ : 0);
  }

 private:
  static constexpr double kTolerance_m = 0.2;

  /// Towards a goal of people, slower while it still has to turn far.
  void head_for(Vec2 goal_W, const PoseReading& pose, double share, Commands& commands) const {
    const Vec2 to_goal_W = goal_W - Vec2{pose.x_m, pose.y_m};
    const Vec2 to_goal_R = rotate(-pose.yaw_rad, to_goal_W);
    const double bearing_rad = atan2(to_goal_R.y, to_goal_R.x);
    const double turned = std::max(0.0, 1 - std::abs(bearing_rad) / deg_to_rad(60));
    const double most_mps =
        std::min(way_.speed_mps(cruise_mps_), std::sqrt(squared_norm(to_goal_W)));
    commands.velocity(drive_, most_mps * share * turned,
                      std::clamp(2 * bearing_rad, -turn_radps_, turn_radps_));
  }

  /// Whether it reverses now: for a while before it turns, as long as nothing that it can see is
  /// behind. What it cannot see there, it runs into.
  bool backs_off() {
    if (back_off_left_ == 0) return false;
    --back_off_left_;
    const double behind_m =
        std::min(scan_.nearest_m(kPi - rear_rad_, kPi), scan_.nearest_m(-kPi, rear_rad_ - kPi));
    const bool blind = (scan_.blind() & Sectors::behind(rear_rad_)).any();
    if (blind || behind_m - radius_m_ < rear_stop_m_) back_off_left_ = 0;
    return back_off_left_ > 0;
  }

  /// 1: left, -1: right; by chance when both are the same.
  int freer_side(const Percepts& percepts) const {
    // Half a radian wider than what counts as ahead: what lies just beside decides where there is
    // room.
    const double left_m = scan_.nearest_m(0, front_rad_ + 0.5);
    const double right_m = scan_.nearest_m(-front_rad_ - 0.5, 0);
    if (left_m == right_m) return percepts.random().bits() % 2 == 0 ? 1 : -1;
    return left_m > right_m ? 1 : -1;
  }

  std::int64_t turn_length(const Percepts& percepts) const {
    const auto choices = static_cast<double>(longest_turn_ - shortest_turn_ + 1);
    return shortest_turn_ + static_cast<std::int64_t>(percepts.random().uniform(0, choices));
  }

  /// The side on which the middle of its area lies, if it has left it and is not heading back; 0 if
  /// all is well.
  int way_home(const PoseReading& pose) const {
    const Vec2 to_centre_W = centre_W_ - Vec2{pose.x_m, pose.y_m};
    if (stay_within_m_ <= 0 || squared_norm(to_centre_W) < stay_within_m_ * stay_within_m_)
      return 0;
    const Vec2 to_centre_R = rotate(-pose.yaw_rad, to_centre_W);
    const double bearing_rad = atan2(to_centre_R.y, to_centre_R.x);
    // Heading roughly home is enough; it need not aim at the middle.
    if (std::abs(bearing_rad) < deg_to_rad(60)) return 0;
    return bearing_rad > 0 ? 1 : -1;
  }

  std::optional<Setup> setup_;
  ControllerHandle drive_;
  Scan scan_;
  double radius_m_ = 0;
  double cruise_mps_ = 0;
  double avoid_m_ = 0;
  double stop_m_ = 0;
  double turn_radps_ = 0;
  double front_rad_ = 0;
  std::int64_t shortest_turn_ = 0;
  std::int64_t longest_turn_ = 0;
  double rear_stop_m_ = 0;
  double rear_rad_ = 0;
  std::int64_t longest_back_off_ = 0;
  std::int64_t back_off_left_ = 0;
  OrderedWay way_;
  Vec2 centre_W_;
  double stay_within_m_ = 0;
  std::int64_t turns_left_ = 0;
  int side_ = 1;
  bool turning_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("wander") {
  rave::add_program<rave::Wander>(registry,
                                  {.name = "wander",
                                   .summary = "Drives about and turns away from near obstacles.",
                                   .params = rave::kParams});
}
