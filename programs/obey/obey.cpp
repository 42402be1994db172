// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    text_param("velocity_sensor", "cmd_vel", "The sensor that gives velocities, if there is one."),
    text_param("goal_sensor", "goal_pose", "The sensor that gives goals, if there is one."),
    number_param("timeout_s", "s", 0.5, 0.02, 60, "An older velocity is none."),
    number_param("speed_mps", "m/s", 0, 0, 10,
                 "Largest speed towards a goal; 0: the controller's own."),
};

/// Does what its sensors say that others want: velocities as long as they come, else the last goal.
/// A velocity ends the goal that came before it.
class Obey final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    const Params params = setup.params();
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    auto wanted = setup.sensor<VelocityReading>(params.text("velocity_sensor"));
    auto goal = setup.sensor<PoseReading>(params.text("goal_sensor"));
    if (!wanted && !goal) return tl::unexpected(std::move(wanted).error());
    if (wanted) wanted_ = *wanted;
    if (goal) {
      RAVE_TRY_ASSIGN(navigate_, setup.controller(CommandKind::kGoal));
      goal_ = *goal;
    }
    return parameters_changed(params);
  }

  Status parameters_changed(const Params& params) override {
    timeout_ = from_seconds(params.number("timeout_s"));
    speed_mps_ = params.number("speed_mps");
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    if (wanted_ && !percepts[*wanted_].empty()) {
      const std::int64_t stamp_ns = percepts.header(*wanted_).stamp_ns;
      if (percepts.now().ns - stamp_ns <= timeout_.ns) {
        const VelocityReading& wanted = percepts[*wanted_].back();
        commands.velocity(drive_, wanted.v_mps, wanted.w_radps);
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
  rave::add_program<rave::Obey>(
      registry, {.name = "obey",
                 .summary = "Does what others want of the robot: velocities, or a goal.",
                 .params = rave::kParams});
}
