// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "rave/math/gaussian.hpp"
#include "rave/math/pose_covariance.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_separation_m", "m", 0.25, 0.001, 100,
                 "Distance between the points where the wheels meet the floor."),
    number_param("wheel_scale_left", "", 1, 0.5, 2,
                 "Measured travel of the left wheel divided by its true travel; 1.01: one per cent "
                 "too much."),
    number_param("wheel_scale_right", "", 1, 0.5, 2,
                 "Measured travel of the right wheel divided by its true travel."),
    number_param("noise_per_metre_m", "m", 0, 0, 1,
                 "Standard deviation of the travel of one wheel after one metre; it grows with the "
                 "square root of the distance."),
};

/// Travel of both wheels since the last sample.
struct WheelTravel {
  double left_m = 0;
  double right_m = 0;
};

/// Wheel odometry of a differential drive, with drift from unequal wheels and random error.
class VirtualOdometry final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kOdometry;

  struct State {
    bool started = false;
    Pose2 X_WR;  ///< True pose at the last sample.
    Pose2 X_OR;  ///< Integrated pose; O is the robot's frame at the first sample.
    PoseCovariance covariance;
  };

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& /*declaration*/) override {
    const Params params = setup.parameters();
    separation_m_ = params.number("wheel_separation_m");
    scale_left_ = params.number("wheel_scale_left");
    scale_right_ = params.number("wheel_scale_right");
    const double sigma_m = params.number("noise_per_metre_m");
    variance_per_metre_m_ = sigma_m * sigma_m;
    return {};
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    State& state = *static_cast<State*>(item.state);
    if (!state.started) {
      state.started = true;
      state.X_WR = item.X_WR;
    }
    // A function of seed, robot, device and sample number, so the drift is the same in each run.
    RandomStream random = item.random();
    const WheelTravel wheels = measured(state.X_WR, item.X_WR);
    const double variance_left_m2 = variance_per_metre_m_ * std::abs(wheels.left_m);
    const double variance_right_m2 = variance_per_metre_m_ * std::abs(wheels.right_m);
    const double left_m = wheels.left_m + std::sqrt(variance_left_m2) * gaussian(random);
    const double right_m = wheels.right_m + std::sqrt(variance_right_m2) * gaussian(random);
    const double length_m = 0.5 * (left_m + right_m);
    const double turn_rad = (right_m - left_m) / separation_m_;

    // Variances of length and turn, and their covariance, from those of two independent wheels
    // (Siegwart and Nourbakhsh, 2004, 5.2.4).
    const ArcVariance arc{0.25 * (variance_left_m2 + variance_right_m2),
                          (variance_left_m2 + variance_right_m2) / (separation_m_ * separation_m_),
                          0.5 * (variance_right_m2 - variance_left_m2) / separation_m_};
    state.covariance.grow(length_m, sincos(state.X_OR.yaw + 0.5 * turn_rad), arc);
    state.X_OR = integrate(state.X_OR, {length_m, 0, turn_rad}, 1.0);
    state.X_WR = item.X_WR;
    report(state, length_m, turn_rad, item);
  }

 private:
  /// The wheel travel between two true poses. Lateral motion turns no wheel.
  [[nodiscard]] WheelTravel measured(const Pose2& X_WR_before, const Pose2& X_WR) const {
    // The constant velocity that leads from one pose to the next in unit time: an arc, whose vx is
    // its length and wz its angle.
    const Twist2 moved = twist_between(X_WR_before, X_WR, 1.0);
    const double half_turn_m = 0.5 * separation_m_ * moved.wz;
    return {scale_left_ * (moved.vx - half_turn_m), scale_right_ * (moved.vx + half_turn_m)};
  }

  static void report(const State& state, double length_m, double turn_rad, const SampleItem& item) {
    auto& reading = *static_cast<OdometryReading*>(item.records);
    const double per_second = item.elapsed_s > 0 ? 1.0 / item.elapsed_s : 0.0;
    reading.x_m = state.X_OR.x;
    reading.y_m = state.X_OR.y;
    reading.yaw_rad = state.X_OR.yaw;
    reading.v_mps = length_m * per_second;
    reading.w_radps = turn_rad * per_second;
    reading.variance_xy_m2 = 0.5 * (state.covariance.xx + state.covariance.yy);
    reading.variance_yaw_rad2 = state.covariance.tt;
    item.header->count = 1;
  }

  double separation_m_ = 0;
  double scale_left_ = 1;
  double scale_right_ = 1;
  double variance_per_metre_m_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_odometry") {
  rave::add_virtual_sensor<rave::VirtualOdometry>(
      registry, {.name = "virtual_odometry",
                 .summary = "Pose integrated from the wheels of a differential drive, with drift.",
                 .params = rave::kParams});
}
