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
    number_param("max_speed_mps", "m/s", 0.5, 0.01, 10, "Speed while fleeing."),
    number_param("calm_speed_mps", "m/s", 0.2, 0, 10, "Speed while no robot is near."),
    number_param("fear_m", "m", 3.0, 0, 100, "Distance below which it flees from robots."),
    number_param("turn_gain_per_s", "1/s", 3.0, 0.1, 100,
                 "Turning rate per radian of heading error."),
    number_param("max_turn_rate_radps", "rad/s", 2.0, 0.1, 10, "Largest turning rate."),
    number_param("stroll_radps", "rad/s", 0.6, 0, 10,
                 "Largest turning rate while no robot is near."),
    number_param("margin_m", "m", 0.1, 0, 10, "Clearance beside the body."),
    number_param("look_m", "m", 1.0, 0.1, 100, "Distance ahead that must be free."),
};

/// Flees from its neighbours, the nearer the more; strolls when no robot is near.
class Prey final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    RAVE_TRY_ASSIGN(eyes_, setup.sensor<NeighbourReading>());
    scan_ = Scan(setup);
    points_R_.reserve(1024);
    return parameters_changed(setup.params());
  }

  Status parameters_changed(const Params& params) override {
    steering_ =
        Steering(setup_->robot_radius_m() + params.number("margin_m"), params.number("look_m"));
    max_speed_mps_ = params.number("max_speed_mps");
    calm_speed_mps_ = std::min(params.number("calm_speed_mps"), max_speed_mps_);
    fear_m_ = params.number("fear_m");
    turn_gain_per_s_ = params.number("turn_gain_per_s");
    max_turn_rate_radps_ = params.number("max_turn_rate_radps");
    stroll_radps_ = params.number("stroll_radps");
    look_m_ = params.number("look_m");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    scan_.update(percepts);
    if (scan_.is_old() || percepts.is_old(eyes_)) {
      commands.velocity(drive_, 0, 0);  // What was free then need not be free now.
      return;
    }
    points_R_.clear();
    for (const RangeHit& hit : scan_.hits()) points_R_.push_back(hit.p_R);

    const Vec2 away_R = away_from(percepts[eyes_]);
    const bool afraid = squared_norm(away_R) > 0;
    const double wanted_rad = afraid ? atan2(away_R.y, away_R.x) : stroll(percepts);
    const FreeHeading way = steering_.best(points_R_, wanted_rad, look_m_);

    const double room = std::clamp(way.free_m / look_m_, 0.0, 1.0);
    const double ahead = std::max(0.0, cos(way.heading_rad));
    commands.velocity(drive_, (afraid ? max_speed_mps_ : calm_speed_mps_) * room * ahead,
                      std::clamp(turn_gain_per_s_ * way.heading_rad, -max_turn_rate_radps_,
                                 max_turn_rate_radps_));
  }

 private:
  /// Sum of the directions away from all neighbours that it fears, weighted by 1 / distance^2 (the
  /// repulsion of O. Khatib, "Real-time obstacle avoidance for manipulators and mobile robots",
  /// IJRR 5(1), 1986, for robots instead of obstacles). Robot frame; zero: no robot is near.
  Vec2 away_from(std::span<const NeighbourReading> seen) const {
    const Pose2 X_RS = eyes_.info().X_RS;
    Vec2 sum_R;
    for (const NeighbourReading& reading : seen) {
      const double range_m = static_cast<double>(reading.range_m);
      if (!(range_m < fear_m_)) continue;
      const SinCos bearing = sincos(static_cast<double>(reading.bearing_rad));
      const Vec2 p_R = transform(X_RS, {range_m * bearing.cos, range_m * bearing.sin});
      const double distance_m = std::max(std::sqrt(squared_norm(p_R)), 0.01);
      // The third power: one for the unit vector p / d, two for the weight 1 / d^2. At least 1 cm,
      // so it stays finite.
      sum_R = sum_R - (1.0 / (distance_m * distance_m * distance_m)) * p_R;
    }
    return sum_R;
  }

  /// A turning rate that itself walks at random gives smooth curves.
  double stroll(const Percepts& percepts) {
    const double change_radps = stroll_radps_ * percepts.random().uniform(-0.3, 0.3);
    stroll_rate_radps_ =
        std::clamp(stroll_rate_radps_ + change_radps, -stroll_radps_, stroll_radps_);
    // As a heading error, because the gain turns it into a rate again below.
    return stroll_rate_radps_ / turn_gain_per_s_;
  }

  std::optional<Setup> setup_;
  ControllerHandle drive_;
  SensorHandle<NeighbourReading> eyes_;
  Scan scan_;
  Steering steering_;
  std::vector<Vec2> points_R_;
  double max_speed_mps_ = 0;
  double calm_speed_mps_ = 0;
  double fear_m_ = 0;
  double turn_gain_per_s_ = 0;
  double max_turn_rate_radps_ = 0;
  double stroll_radps_ = 0;
  double look_m_ = 0;
  double stroll_rate_radps_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("prey") {
  rave::add_program<rave::Prey>(registry,
                                {.name = "prey",
                                 .summary = "Flees from near robots; strolls while there are none.",
                                 .params = rave::kParams});
}
