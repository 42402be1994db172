// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"
#include "wheel_speeds.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_separation_m", "m", 0.3, 0.001, 100,
                 "Distance between the points where the two driven wheels touch the floor."),
    number_param("max_wheel_speed_mps", "m/s", 1.0, 0, 100, "Largest speed of each wheel."),
};

/// Two driven wheels without inertia: a speed within the limits is reached at once.
class DifferentialDrive final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }

  Status parameters_changed(const Params& params) override {
    separation_m_ = params.number("wheel_separation_m");
    max_mps_ = params.number("max_wheel_speed_mps");
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    return body_velocity(wanted_speeds(input.command, separation_m_, max_mps_), separation_m_);
  }

 private:
  double separation_m_ = 0;
  double max_mps_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("differential_drive") {
  rave::add_virtual_actuator<rave::DifferentialDrive>(
      registry, {.name = "differential_drive",
                 .summary = "Kinematic differential drive: reaches the commanded velocity at once.",
                 .params = rave::kParams});
}
