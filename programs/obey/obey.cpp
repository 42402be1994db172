// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "rave/robot/ordered_way.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    text_param("velocity_sensor", "cmd_vel", "Sensor that gives velocities; empty: none."),
    text_param("goal_sensor", "goal_pose", "Sensor that gives goals; empty: none."),
    number_param("timeout_s", "s", 0.5, 0.02, 60, "Age after which a velocity is ignored."),
    number_param("speed_mps", "m/s", 0, 0, 10,
                 "Largest speed towards a goal; 0: that of the controller."),
};

/// Does what its sensors say that others want: velocities as long as they come, else the last goal.
/// A velocity ends the goal that came before it. Goals and paths of people count before both.
class Obey final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath | kTakesText;

  Status start(const Setup& setup) override {
    const Params params = setup.params();
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    const std::string_view velocity_sensor = params.text("velocity_sensor");
    const std::string_view goal_sensor = params.text("goal_sensor");
    auto wanted = setup.sensor<VelocityReading>(velocity_sensor);
    auto goal = setup.sensor<PoseReading>(goal_sensor);
    // Without any sensor named it takes orders of people only, so a missing sensor is no error
    // then.
    const bool people_alone = velocity_sensor.empty() && goal_sensor.empty();
    if (people_alone) return begin(setup);
    if (!wanted && !goal) return tl::unexpected(std::move(wanted).error());
    if (wanted) wanted_ = *wanted;
    if (goal) {
      RAVE_TRY_ASSIGN(navigate_, setup.controller(CommandKind::kGoal));
      goal_ = *goal;
    }
    return begin(setup);
  }

  Status parameters_changed(const Params& params) override {
    timeout_ = from_seconds(params.number("timeout_s"));
    speed_mps_ = params.number("speed_mps");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    if (follows_people(percepts, commands)) return;
    if (wanted_ && !percepts[*wanted_].empty()) {
      const std::int64_t stamp_ns = percepts.header(*wanted_).stamp_ns;
      if (percepts.now().ns - stamp_ns <= timeout_.ns) {
        const VelocityReading& wanted = percepts[*wanted_].back();
        commands.velocity(drive_, wanted.v_mps, wanted.w_radps);
        // A goal older than this velocity has ended: when velocities stop coming the robot stands,
        // and does not return to an old goal.
        ended_ns_ = stamp_ns;
        return;
      }
    }
    if (goal_ && !percepts[*goal_].empty() && percepts.header(*goal_).stamp_ns > ended_ns_) {
      const PoseReading& goal = percepts[*goal_].back();
      commands.goal(navigate_, {goal.x_m, goal.y_m}, speed_mps_);
      return;
    }
    commands.velocity(drive_, 0, 0);
  }

 private:
  Status begin(const Setup& setup) {
    const auto navigate = setup.controller(CommandKind::kGoal);
    can_navigate_ = navigate.has_value();
    if (navigate) navigate_ = *navigate;
    return parameters_changed(setup.params());
  }

  /// Goals and paths that people gave; false: there are none.
  bool follows_people(const Percepts& percepts, Commands& commands) {
    for (const Order order : percepts.orders()) {
      if (order.kind == OrderKind::kText) commands.say("I obey goals and paths, not texts.");
    }
    way_.update(percepts, commands, kTolerance_m);
    if (way_.state() == OrderedWay::State::kNone) return false;
    if (way_.state() == OrderedWay::State::kGoing && can_navigate_) {
      commands.goal(navigate_, way_.next(),
                    speed_mps_ > 0 ? way_.speed_mps(speed_mps_) : way_.asked_speed_mps());
    } else if (way_.state() == OrderedWay::State::kTurning) {
      commands.velocity(drive_, 0, way_.turn_radps(percepts.pose(), kTurn_radps));
    } else {
      if (way_.state() == OrderedWay::State::kGoing && !complained_) {
        complained_ = commands.done("I cannot go there: none of my controllers takes goals.");
      }
      commands.velocity(drive_, 0, 0);
    }
    return true;
  }

  static constexpr double kTolerance_m = 0.15;
  static constexpr double kTurn_radps = 1;

  OrderedWay way_;
  bool can_navigate_ = false;
  bool complained_ = false;
  std::optional<SensorHandle<VelocityReading>> wanted_;
  std::optional<SensorHandle<PoseReading>> goal_;
  ControllerHandle drive_;
  ControllerHandle navigate_;
  Duration timeout_;
  double speed_mps_ = 0;
  std::int64_t ended_ns_ = -1;  ///< Goals up to then count no more.
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("obey") {
  rave::add_program<rave::Obey>(registry,
                                {.name = "obey",
                                 .summary = "Obeys velocities, goals and paths from outside.",
                                 .params = rave::kParams});
}
