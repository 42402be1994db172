// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/scan.hpp"
#include "rave/robot/steering.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    text_param("communicator", "", "Communicator to use; empty: the first of the robot."),
    number_param("cruise_mps", "m/s", 0.25, 0.01, 10, "Speed of the flock."),
    number_param("spacing_m", "m", 0.8, 0.01, 100, "Distance below which neighbours push it away."),
    number_param("separation", "", 1.5, 0, 100, "Weight of keeping the distance."),
    number_param("alignment", "", 1.0, 0, 100, "Weight of the direction of the neighbours."),
    number_param("cohesion", "1/m", 0.5, 0, 100, "Weight of the centre of the neighbours."),
    number_param("forget_s", "s", 0.5, 0.01, 60,
                 "Time after which a silent neighbour is forgotten."),
    number_param("turn_gain_per_s", "1/s", 2.0, 0.1, 100,
                 "Turning rate per radian of heading error."),
    number_param("max_turn_radps", "rad/s", 1.5, 0.1, 10, "Largest turning rate."),
    number_param("margin_m", "m", 0.08, 0, 10, "Clearance beside the body."),
    number_param("look_m", "m", 0.5, 0.1, 100, "Distance ahead that must be free."),
    number_param("centre_x_m", "m", 0, -1e6, 1e6, "Middle of the area to stay in, world frame."),
    number_param("centre_y_m", "m", 0, -1e6, 1e6, "Middle of the area to stay in, world frame."),
    number_param("stay_within_m", "m", 0, 0, 1e6, "Radius of that area; 0: no limit."),
};

/// What each robot tells the others: its reported pose, and its velocity, world frame.
struct FlockMessage {
  double x_m = 0;
  double y_m = 0;
  double vx_mps = 0;
  double vy_mps = 0;
};

struct Neighbour {
  std::uint32_t robot = 0;
  SimTime stamp;
  Vec2 p_W;
  Vec2 v_W;
};

/// Flies with its neighbours as boids do: away from those too near, the way they go, towards their
/// middle. Source: C. W. Reynolds, "Flocks, Herds, and Schools: A Distributed Behavioral Model",
/// SIGGRAPH 1987. It knows of them by their messages alone.
class Flock final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    const Params params = setup.params();
    RAVE_TRY_ASSIGN(radio_, setup.communicator(params.text("communicator")));
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    scan_ = Scan(setup);
    steering_ =
        Steering(setup.robot_radius_m() + params.number("margin_m"), params.number("look_m"));
    period_s_ = setup.period_s();
    cruise_mps_ = params.number("cruise_mps");
    spacing_m_ = params.number("spacing_m");
    separation_ = params.number("separation");
    alignment_ = params.number("alignment");
    cohesion_ = params.number("cohesion");
    forget_ = from_seconds(params.number("forget_s"));
    turn_gain_per_s_ = params.number("turn_gain_per_s");
    max_turn_radps_ = params.number("max_turn_radps");
    look_m_ = params.number("look_m");
    centre_W_ = {params.number("centre_x_m"), params.number("centre_y_m")};
    stay_within_m_ = params.number("stay_within_m");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    scan_.update(percepts);
    listen(percepts);
    const PoseReading& pose = percepts.pose();
    const Vec2 p_W{pose.x_m, pose.y_m};
    // Half of the last velocity: motion capture shakes a little.
    if (moved_) v_W_ = 0.5 * v_W_ + (0.5 / period_s_) * (p_W - last_p_W_);
    moved_ = true;
    last_p_W_ = p_W;
    // Sent also when it stands for lack of a scan: the others still need to know where it is.
    commands.send(radio_, FlockMessage{p_W.x, p_W.y, v_W_.x, v_W_.y});
    if (scan_.is_old()) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    steer(rotate(-pose.yaw_rad, desired_velocity(p_W, pose.yaw_rad)), commands);
  }

 private:
  /// Keeps the newest word of each neighbour, ordered by robot.
  void listen(const Percepts& percepts) {
    for (const Message message : percepts.messages(radio_)) {
      const auto said = message.as<FlockMessage>();
      if (!said) continue;
      const Neighbour heard{
          message.from, message.stamp, {said->x_m, said->y_m}, {said->vx_mps, said->vy_mps}};
      const auto place =
          std::lower_bound(neighbours_.begin(), neighbours_.end(), heard.robot,
                           [](const Neighbour& n, std::uint32_t robot) { return n.robot < robot; });
      if (place != neighbours_.end() && place->robot == heard.robot) {
        *place = heard;
      } else {
        neighbours_.insert(place, heard);
      }
    }
    std::erase_if(neighbours_,
                  [&](const Neighbour& n) { return percepts.now() - n.stamp > forget_; });
    now_ = percepts.now();
  }

  /// Where it would like to go, world frame; of length 1 and more.
  [[nodiscard]] Vec2 desired_velocity(Vec2 p_W, double yaw_rad) const {
    const SinCos ahead = sincos(yaw_rad);
    Vec2 desired_W{ahead.cos, ahead.sin};
    Vec2 middle_W;
    Vec2 flow_W;
    for (const Neighbour& n : neighbours_) {
      // Where the neighbour should be by now: a message is old by at least one step.
      const Vec2 there_W = n.p_W + (now_ - n.stamp).seconds() * n.v_W;
      const Vec2 away_W = p_W - there_W;
      const double distance_m = std::max(std::sqrt(squared_norm(away_W)), 0.01);
      if (distance_m < spacing_m_) {
        // Grows from 0 at the spacing without limit towards contact: (s/d - 1) in the direction
        // away.
        desired_W = desired_W + (separation_ * (spacing_m_ / distance_m - 1) / distance_m) * away_W;
      }
      middle_W = middle_W + there_W;
      flow_W = flow_W + n.v_W;
    }
    if (!neighbours_.empty()) {
      // Means, not sums, so the weights do not depend on the number of neighbours.
      const double share = 1.0 / static_cast<double>(neighbours_.size());
      desired_W = desired_W + cohesion_ * (share * middle_W - p_W);
      desired_W = desired_W + (alignment_ * share / cruise_mps_) * flow_W;
    }
    const Vec2 home_W = centre_W_ - p_W;
    const double out_m = std::sqrt(squared_norm(home_W)) - stay_within_m_;
    // Grows with the distance outside, so it exceeds the pull of the flock soon.
    if (stay_within_m_ > 0 && out_m > 0) desired_W = desired_W + (2 * out_m) * home_W;
    return desired_W;
  }

  void steer(Vec2 desired_R, Commands& commands) {
    points_R_.clear();
    for (const RangeHit& hit : scan_.hits()) points_R_.push_back(hit.p_R);
    const FreeHeading way = steering_.best(points_R_, atan2(desired_R.y, desired_R.x), look_m_);
    const double room = std::clamp(way.free_m / look_m_, 0.0, 1.0);
    const double ahead = std::max(0.0, cos(way.heading_rad));
    commands.velocity(
        drive_, cruise_mps_ * room * ahead,
        std::clamp(turn_gain_per_s_ * way.heading_rad, -max_turn_radps_, max_turn_radps_));
  }

  CommunicatorHandle radio_;
  ControllerHandle drive_;
  Scan scan_;
  Steering steering_;
  std::vector<Neighbour> neighbours_;
  std::vector<Vec2> points_R_;
  SimTime now_;
  Duration forget_;
  double period_s_ = 0;
  double cruise_mps_ = 0;
  double spacing_m_ = 0;
  double separation_ = 0;
  double alignment_ = 0;
  double cohesion_ = 0;
  double turn_gain_per_s_ = 0;
  double max_turn_radps_ = 0;
  double look_m_ = 0;
  Vec2 centre_W_;
  double stay_within_m_ = 0;
  Vec2 last_p_W_;
  Vec2 v_W_;
  bool moved_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("flock") {
  rave::add_program<rave::Flock>(
      registry, {.name = "flock",
                 .summary = "Moves with its neighbours, which report their poses by radio.",
                 .params = rave::kParams});
}
