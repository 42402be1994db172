// SPDX-License-Identifier: Apache-2.0
#include "differential_drive/wheel_speeds.hpp"
#include "differential_drive_dynamic/driven_wheel.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_separation_m", "m", 0.3, 0.001, 100,
                 "Distance between the middles of the two sides."),
    number_param("max_wheel_speed_mps", "m/s", 1.0, 0, 100, "Largest speed of each side."),
    number_param("slide_factor", "", 1.6, 1, 10,
                 "How many times as far apart the sides seem to be when it turns, because their "
                 "wheels slide."),
    number_param(
        "turn_centre_m", "m", 0, -100, 100,
        "How far ahead of the origin the point is that does not slide sideways in a turn."),
};
constexpr auto kDynamicParams = with_driven_wheels(kParams);

/// Wheels or tracks on both sides that slide in turns. Source: A. Mandow, J. L. Martinez, J.
/// Morales, J. L. Blanco, A. Garcia-Cerezo, J. Gonzalez, "Experimental kinematics for wheeled
/// skid-steer mobile robots", IROS 2007: fixed centres of rotation, symmetric about the middle.
struct Sides {
  double separation_m = 0.3;  ///< As it seems in a turn.
  double max_mps = 1;
  double turn_centre_m = 0;

  void set(const Params& params) {
    separation_m = params.number("wheel_separation_m") * params.number("slide_factor");
    max_mps = params.number("max_wheel_speed_mps");
    turn_centre_m = params.number("turn_centre_m");
  }
  [[nodiscard]] WheelSpeeds wanted(const Command& command) const noexcept {
    return wanted_speeds(command, separation_m, max_mps);
  }
  [[nodiscard]] Twist2 motion(WheelSpeeds speeds) const noexcept {
    Twist2 motion = body_velocity(speeds, separation_m);
    motion.vy = -turn_centre_m * motion.wz;
    return motion;
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return motion(wanted(command));
  }
};

/// Both sides reach their speed at once.
class SkidSteerDrive final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }
  Status parameters_changed(const Params& params) override {
    sides_.set(params);
    return {};
  }

  Twist2 propose(const MotionInput& input) override { return motion_of(input.command); }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return sides_.motion_of(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return velocity_command(motion.vx, motion.wz);
  }

 private:
  Sides sides_;
};

/// Both sides follow as driven wheels, and each slips now and then.
class SkidSteerDriveDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    left_ = {};
    right_ = {};
    take(setup.parameters(), setup.step_s);
    return {};
  }
  Status parameters_changed(const Params& params) override {
    take(params, wheels_.dt_s());
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != wheels_.dt_s()) wheels_.prepare(input.dt_s);
    if (input.contact != 0) {
      const WheelSpeeds now =
          wheel_speeds(input.velocity.vx, input.velocity.wz, sides_.separation_m);
      left_.restart(now.left_mps);
      right_.restart(now.right_mps);
    }
    const WheelSpeeds wanted = sides_.wanted(input.command);
    RandomStream random = input.random();
    const double left_draw = random.uniform();
    const double right_draw = random.uniform();
    return sides_.motion({wheels_.advance(left_, wanted.left_mps, left_draw),
                          wheels_.advance(right_, wanted.right_mps, right_draw)});
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return sides_.motion_of(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return velocity_command(motion.vx, motion.wz);
  }

 private:
  void take(const Params& params, double dt_s) {
    sides_.set(params);
    wheels_.set(params, dt_s);
  }

  Sides sides_;
  DrivenWheels wheels_;
  DrivenWheel left_;
  DrivenWheel right_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("skid_steer_drive skid_steer_drive_dynamic") {
  rave::add_virtual_actuator<rave::SkidSteerDrive>(
      registry,
      {.name = "skid_steer_drive",
       .summary = "Kinematic drive with wheels or tracks on both sides that slide when it "
                  "turns.",
       .params = rave::kParams});
  rave::add_virtual_actuator<rave::SkidSteerDriveDynamic>(
      registry, {.name = "skid_steer_drive_dynamic",
                 .summary = "Skid-steer drive with second-order sides and occasional slip.",
                 .params = rave::kDynamicParams});
}
