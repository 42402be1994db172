// SPDX-License-Identifier: Apache-2.0
#include "differential_drive/wheel_speeds.hpp"
#include "differential_drive_dynamic/driven_wheel.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kOwnParams[] = {
    number_param("wheel_separation_m", "m", 0.3, 0.001, 100,
                 "Distance between the points where the two driven wheels touch the floor."),
    number_param("max_wheel_speed_mps", "m/s", 1.0, 0, 100, "Largest commanded wheel speed."),
};
constexpr auto kParams = with_driven_wheels(kOwnParams);

/// Two driven wheels with second-order speed control and occasional slip.
class DifferentialDriveDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    left_ = {};
    right_ = {};
    take(setup.parameters(), setup.step_s);
    return {};
  }

  /// The wheels keep their present speeds.
  Status parameters_changed(const Params& params) override {
    take(params, wheels_.dt_s());
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != wheels_.dt_s()) wheels_.prepare(input.dt_s);
    // A contact takes the speed from the wheels. Otherwise the robot would jump to its old speed as
    // soon as the contact ends.
    if (input.contact != 0) restart_from(input.velocity);
    const WheelSpeeds wanted = wanted_speeds(input.command, separation_m_, max_mps_);
    // Always take two draws, so that slip of one wheel does not change the random numbers of the
    // other.
    RandomStream random = input.random();
    const double left_draw = random.uniform();
    const double right_draw = random.uniform();
    return body_velocity({wheels_.advance(left_, wanted.left_mps, left_draw),
                          wheels_.advance(right_, wanted.right_mps, right_draw)},
                         separation_m_);
  }

 private:
  void take(const Params& params, double dt_s) {
    separation_m_ = params.number("wheel_separation_m");
    max_mps_ = params.number("max_wheel_speed_mps");
    wheels_.set(params, dt_s);
  }

  void restart_from(const Twist2& velocity) {
    const WheelSpeeds now = wheel_speeds(velocity.vx, velocity.wz, separation_m_);
    left_.restart(now.left_mps);
    right_.restart(now.right_mps);
  }

  double separation_m_ = 0;
  double max_mps_ = 0;
  DrivenWheels wheels_;
  DrivenWheel left_;
  DrivenWheel right_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("differential_drive_dynamic") {
  rave::add_virtual_actuator<rave::DifferentialDriveDynamic>(
      registry, {.name = "differential_drive_dynamic",
                 .summary = "Differential drive with second-order wheels, limited acceleration and "
                            "occasional wheel slip.",
                 .params = rave::kParams});
}
