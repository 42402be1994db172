// SPDX-License-Identifier: Apache-2.0
// A robot program: drives ahead, slows down near obstacles and turns to the side with more room.
#include <algorithm>
#include <rave/math/scalar.hpp>
#include <rave/robot/plugin_entry.hpp>
#include <rave/robot/scan.hpp>

namespace {

using rave::deg_to_rad;

class KeepClear final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    scan_ = rave::Scan(setup);  // All range sensors of the robot, whichever it has.
    RAVE_TRY_ASSIGN(drive_, setup.controller(rave::CommandKind::kVelocity));
    speed_mps_ = setup.params().number("speed_mps");
    return {};
  }

  void decide(const rave::Percepts& percepts, rave::Commands& commands) override {
    scan_.update(percepts);
    if (scan_.is_old()) {  // A sensor fell silent: what it showed as free may be occupied.
      commands.velocity(drive_, 0, 0);
      return;
    }
    const double ahead_m = scan_.nearest_m(deg_to_rad(-30), deg_to_rad(30));
    const double left_m = scan_.nearest_m(deg_to_rad(30), deg_to_rad(100));
    const double right_m = scan_.nearest_m(deg_to_rad(-100), deg_to_rad(-30));
    // Full speed with 1 m of room, none below 0.3 m: the robot then turns on the spot.
    const double room = std::clamp((ahead_m - 0.3) / 0.7, 0.0, 1.0);
    const double turn_radps = room < 1 ? (left_m > right_m ? 1.0 : -1.0) : 0.0;
    commands.velocity(drive_, speed_mps_ * room, turn_radps);
  }

 private:
  rave::Scan scan_;
  rave::ControllerHandle drive_;
  double speed_mps_ = 0;
};

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("speed_mps", "m/s", 0.3, 0.0, 2.0, "Speed with enough room ahead."),
};

}  // namespace

RAVE_PLUGIN("keep_clear") {
  rave::add_program<KeepClear>(registry, {.name = "keep_clear",
                                          .summary = "Drives ahead and turns away from obstacles.",
                                          .params = kParams});
}
