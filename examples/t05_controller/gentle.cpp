// SPDX-License-Identifier: Apache-2.0
// A controller between program and actuator: velocities with limited acceleration.
#include <algorithm>
#include <cmath>
#include <rave/robot/plugin_entry.hpp>

namespace {

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("max_accel_mps2", "m/s^2", 0.2, 0.001, 100, "Largest acceleration."),
    rave::number_param("watchdog_s", "s", 0.5, 0.001, 3600, "Age at which a command expires."),
};

class Gentle final : public rave::Controller {
 public:
  static constexpr rave::CommandKind kAccepts = rave::CommandKind::kVelocity;
  static constexpr rave::CommandKind kGives = rave::CommandKind::kVelocity;

  rave::Status start(const rave::DeviceSetup& setup) override {
    v_mps_ = 0;
    return parameters_changed(setup.parameters());
  }

  // Permits `rave set ROBOT controller.drive.max_accel_mps2 VALUE` during a run.
  rave::Status parameters_changed(const rave::Params& params) override {
    max_accel_mps2_ = params.number("max_accel_mps2");
    watchdog_s_ = params.number("watchdog_s");
    return {};
  }

  rave::Command control(const rave::ControlInput& input) override {
    const double wanted_mps = input.command.value[0];
    const double turn_radps = input.command.value[1];
    // A program that has stopped deciding, or decides nonsense, must not keep the robot moving.
    const bool good = input.command.kind == kAccepts && input.command_age_s <= watchdog_s_ &&
                      std::isfinite(wanted_mps) && std::isfinite(turn_radps);
    if (!good) {
      v_mps_ = 0;
      return rave::velocity_command(0, 0);
    }
    const double most_mps = max_accel_mps2_ * input.dt_s;
    v_mps_ += std::clamp(wanted_mps - v_mps_, -most_mps, most_mps);
    return rave::velocity_command(v_mps_, turn_radps);
  }

 private:
  double max_accel_mps2_ = 0;
  double watchdog_s_ = 0;
  double v_mps_ = 0;
};

}  // namespace

RAVE_PLUGIN("gentle") {
  rave::add_controller<Gentle>(
      registry,
      {.name = "gentle", .summary = "Velocities with limited acceleration.", .params = kParams});
}
