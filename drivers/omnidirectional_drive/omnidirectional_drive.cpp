// SPDX-License-Identifier: Apache-2.0
#include "differential_drive_dynamic/driven_wheel.hpp"
#include "omni_wheels.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    integer_param("wheels", 3, 3, static_cast<std::int64_t>(OmniWheels::kMost),
                  "Number of wheels, equally spaced on a circle."),
    number_param("wheel_circle_m", "m", 0.15, 0.001, 100, "Radius of that circle."),
    number_param("first_wheel_deg", "deg", 60, -360, 360,
                 "Direction of the first wheel from the middle, counter-clockwise from ahead."),
    number_param("max_wheel_speed_mps", "m/s", 1.0, 0, 100, "Largest speed of each wheel."),
};
constexpr auto kDynamicParams = with_driven_wheels(kParams);

/// Reaches any velocity that its wheels can at once.
class OmnidirectionalDrive final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }
  Status parameters_changed(const Params& params) override {
    wheels_.set(params);
    return {};
  }

  Twist2 propose(const MotionInput& input) override { return motion_of(input.command); }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return wheels_.limited(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return velocity_command(motion.vx, motion.wz, motion.vy);
  }

 private:
  OmniWheels wheels_;
};

/// Each wheel follows as a driven wheel, and slips now and then.
class OmnidirectionalDriveDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    driven_.fill({});
    take(setup.parameters(), setup.step_s);
    return {};
  }
  Status parameters_changed(const Params& params) override {
    take(params, dynamics_.dt_s());
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != dynamics_.dt_s()) dynamics_.prepare(input.dt_s);
    if (input.contact != 0) {
      const OmniWheels::Speeds now = wheels_.speeds(input.velocity);
      for (std::size_t i = 0; i < wheels_.count(); ++i) driven_[i].restart(now[i]);
    }
    OmniWheels::Speeds speeds = wheels_.speeds(motion_of(input.command));
    RandomStream random = input.random();
    for (std::size_t i = 0; i < wheels_.count(); ++i) {
      speeds[i] = dynamics_.advance(driven_[i], speeds[i], random.uniform());
    }
    return wheels_.body(speeds);
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return wheels_.limited(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return velocity_command(motion.vx, motion.wz, motion.vy);
  }

 private:
  void take(const Params& params, double dt_s) {
    wheels_.set(params);
    dynamics_.set(params, dt_s);
  }

  OmniWheels wheels_;
  DrivenWheels dynamics_;
  std::array<DrivenWheel, OmniWheels::kMost> driven_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("omnidirectional_drive omnidirectional_drive_dynamic") {
  rave::add_virtual_actuator<rave::OmnidirectionalDrive>(
      registry, {.name = "omnidirectional_drive",
                 .summary = "Kinematic drive with omnidirectional wheels: forward, sideways and "
                            "turning at once.",
                 .params = rave::kParams});
  rave::add_virtual_actuator<rave::OmnidirectionalDriveDynamic>(
      registry, {.name = "omnidirectional_drive_dynamic",
                 .summary = "Omnidirectional drive with second-order wheels and occasional slip.",
                 .params = rave::kDynamicParams});
}
