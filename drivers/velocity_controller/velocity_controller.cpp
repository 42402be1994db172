// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("max_speed_mps", "m/s", 0.5, 0, 100, "Largest speed, forward and backward."),
    number_param("max_turn_rate_radps", "rad/s", 2.0, 0, 100, "Largest turning rate, both ways."),
    number_param("watchdog_s", "s", 0.5, 0.001, 3600,
                 "Age of the last command after which the robot stops."),
};

/// Passes velocities on within limits; stops without a fresh and finite command.
class VelocityController final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    host_ = setup.host;
    complained_ = false;
    return parameters_changed(setup.parameters());
  }

  Status parameters_changed(const Params& params) override {
    max_speed_mps_ = params.number("max_speed_mps");
    max_turn_rate_radps_ = params.number("max_turn_rate_radps");
    watchdog_s_ = params.number("watchdog_s");
    return {};
  }

  Command control(const ControlInput& input) override {
    // Written with "not" so that an age of NaN stops the robot as well.
    if (input.command.kind != kAccepts || !(input.command_age_s <= watchdog_s_)) return kStop;
    const double v_mps = input.command.value[0];
    const double w_radps = input.command.value[1];
    const double vy_mps = input.command.count > 2 ? input.command.value[2] : 0;
    if (!std::isfinite(v_mps) || !std::isfinite(w_radps) || !std::isfinite(vy_mps)) {
      complain(v_mps, w_radps, vy_mps);
      return kStop;
    }
    const double turn_radps = std::clamp(w_radps, -max_turn_rate_radps_, max_turn_rate_radps_);
    if (vy_mps == 0) {
      return velocity_command(std::clamp(v_mps, -max_speed_mps_, max_speed_mps_), turn_radps);
    }
    // Scaled together, so that the direction stays.
    const double speed_mps = hypot(v_mps, vy_mps);
    const double scale = speed_mps > max_speed_mps_ ? max_speed_mps_ / speed_mps : 1;
    return velocity_command(scale * v_mps, turn_radps, scale * vy_mps);
  }

 private:
  static constexpr Command kStop = velocity_command(0, 0);

  // Logged once, because a faulty program repeats the same command.
  void complain(double v_mps, double w_radps, double vy_mps) {
    if (complained_) return;
    complained_ = true;
    host_.write(LogLevel::kWarning,
                fmt::format("a velocity command is not finite (v = {} m/s, w = {} rad/s, vy = {} "
                            "m/s); the robot stops; later ones are not reported",
                            v_mps, w_radps, vy_mps));
  }

  HostServices host_;
  double max_speed_mps_ = 0;
  double max_turn_rate_radps_ = 0;
  double watchdog_s_ = 0;
  bool complained_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("velocity") {
  rave::add_controller<rave::VelocityController>(
      registry, {.name = "velocity",
                 .summary = "Passes velocities on within limits; stops without new commands.",
                 .params = rave::kParams});
}
