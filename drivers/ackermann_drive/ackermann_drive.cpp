// SPDX-License-Identifier: Apache-2.0
#include "car_geometry.hpp"
#include "differential_drive_dynamic/driven_wheel.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_base_m", "m", 0.3, 0.001, 100, "Distance between the axles."),
    number_param("max_steering_deg", "deg", 30, 0, 80, "Largest steering angle, both ways."),
    number_param("max_speed_mps", "m/s", 1.5, 0, 100, "Largest speed forward."),
    number_param("max_reverse_mps", "m/s", 0.7, 0, 100, "Largest speed backward."),
};
constexpr ParamSpec kDynamicParams[] = {
    kParams[0],
    kParams[1],
    kParams[2],
    kParams[3],
    number_param("max_steering_rate_degps", "deg/s", 120, 0.1, 10'000,
                 "Largest rate of the steering angle."),
    number_param("max_braking_mps2", "m/s^2", 4, 0.001, 10'000,
                 "Deceleration of the full brake; half a brake reaches half of it."),
};
constexpr auto kAllDynamicParams = with_driven_wheels(kDynamicParams);

/// A car without inertia: speed and steering are reached at once.
class AckermannDrive final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kPedals;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }
  Status parameters_changed(const Params& params) override {
    car_.set(params);
    return {};
  }

  Twist2 propose(const MotionInput& input) override { return motion_of(input.command); }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return car_.motion_of(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return car_.command_for(motion);
  }

 private:
  CarGeometry car_;
};

/// A car whose rear axle follows as a driven wheel, with a brake, and whose steering takes time.
class AckermannDriveDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kPedals;

  Status start(const DeviceSetup& setup) override {
    axle_ = {};
    steering_rad_ = 0;
    take(setup.parameters(), setup.step_s);
    return {};
  }
  /// Speed and steering stay as they are.
  Status parameters_changed(const Params& params) override {
    take(params, wheels_.dt_s());
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != wheels_.dt_s()) wheels_.prepare(input.dt_s);
    if (input.contact != 0) axle_.restart(input.velocity.vx);
    const CarWish wish = car_.wish(input.command);
    const double most_rad = max_steering_rate_radps_ * input.dt_s;
    steering_rad_ += std::clamp(wish.steering_rad - steering_rad_, -most_rad, most_rad);
    const double before_mps = axle_.speed.speed_mps;
    const double over_ground_mps =
        wheels_.advance(axle_, wish.speed_mps, input.random().uniform(),
                        std::max(wheels_.max_acceleration_mps2(), wish.brake * max_braking_mps2_));
    if (is_forbidden(wish, before_mps, axle_.speed.speed_mps)) {
      axle_.restart(0);
      return {};
    }
    return car_.motion(over_ground_mps, steering_rad_);
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return car_.motion_of(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return car_.command_for(motion);
  }

 private:
  void take(const Params& params, double dt_s) {
    car_.set(params);
    max_steering_rate_radps_ = deg_to_rad(params.number("max_steering_rate_degps"));
    max_braking_mps2_ = params.number("max_braking_mps2");
    wheels_.set(params, dt_s);
  }

  /// A speed that overshoots through zero: the gear forbids the other direction, and who brakes
  /// stands then.
  static bool is_forbidden(const CarWish& wish, double before_mps, double now_mps) noexcept {
    if (before_mps * now_mps > 0) return false;
    return wish.speed_mps == 0 || (now_mps < 0 ? wish.gear >= 0 : wish.gear <= 0);
  }

  CarGeometry car_;
  double max_steering_rate_radps_ = 0;
  double max_braking_mps2_ = 0;
  DrivenWheels wheels_;
  DrivenWheel axle_;
  double steering_rad_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("ackermann_drive ackermann_drive_dynamic") {
  rave::add_virtual_actuator<rave::AckermannDrive>(
      registry, {.name = "ackermann_drive",
                 .summary = "Kinematic car: steering, throttle, brake and gear, or a velocity.",
                 .params = rave::kParams});
  rave::add_virtual_actuator<rave::AckermannDriveDynamic>(
      registry, {.name = "ackermann_drive_dynamic",
                 .summary = "Car with a second-order rear axle, a brake, steering that takes time "
                            "and occasional slip.",
                 .params = rave::kAllDynamicParams});
}
