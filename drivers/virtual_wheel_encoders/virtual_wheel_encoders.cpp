// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "rave/math/gaussian.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_separation_m", "m", 0.25, 0.001, 100,
                 "Distance between the points where the wheels meet the floor."),
    number_param("wheel_radius_m", "m", 0.035, 0.0001, 10, "Radius of the wheels."),
    number_param("wheel_scale_left", "", 1, 0.5, 2,
                 "Measured travel of the left wheel divided by its true travel."),
    number_param("wheel_scale_right", "", 1, 0.5, 2,
                 "Measured travel of the right wheel divided by its true travel."),
    integer_param("ticks_per_turn", 512, 1, 10'000'000, "Ticks in one turn of a wheel."),
    integer_param("counter_bits", 0, 0, 32,
                  "Bits of the counters, which start again at 0 when they are full; 0: counters "
                  "that are never full and count below 0 backwards."),
    number_param("noise_per_metre_m", "m", 0, 0, 1,
                 "Standard deviation of the travel of one wheel after one metre; it grows with the "
                 "square root of the distance."),
};

/// Counters of the ticks of both wheels of a differential drive since the first sample.
class VirtualWheelEncoders final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  struct State {
    bool started = false;
    Pose2 X_WR;  ///< True pose at the last sample.
    double left_m = 0;
    double right_m = 0;
  };

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    separation_m_ = params.number("wheel_separation_m");
    scale_left_ = params.number("wheel_scale_left");
    scale_right_ = params.number("wheel_scale_right");
    const auto ticks = static_cast<double>(params.integer("ticks_per_turn"));
    ticks_per_metre_ = ticks / (2 * kPi * params.number("wheel_radius_m"));
    const std::int64_t bits = params.integer("counter_bits");
    full_ = bits == 0 ? 0 : static_cast<double>(std::int64_t{1} << bits);
    const double sigma_m = params.number("noise_per_metre_m");
    variance_per_metre_m_ = sigma_m * sigma_m;
    declaration.capacity = 2;
    return {};
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    State& state = *static_cast<State*>(item.state);
    if (!state.started) {
      state.started = true;
      state.X_WR = item.X_WR;
    }
    RandomStream random = item.random();
    // The constant velocity that leads from one pose to the next in unit time: an arc, whose vx is
    // its length and wz its angle. Lateral motion turns no wheel.
    const Twist2 moved = twist_between(state.X_WR, item.X_WR, 1.0);
    const double half_turn_m = 0.5 * separation_m_ * moved.wz;
    state.left_m += with_noise(scale_left_ * (moved.vx - half_turn_m), random);
    state.right_m += with_noise(scale_right_ * (moved.vx + half_turn_m), random);
    state.X_WR = item.X_WR;
    auto* const ticks = static_cast<double*>(item.records);
    ticks[0] = count(state.left_m);
    ticks[1] = count(state.right_m);
    item.header->count = 2;
  }

 private:
  [[nodiscard]] double with_noise(double travel_m, RandomStream& random) const {
    return travel_m + std::sqrt(variance_per_metre_m_ * std::abs(travel_m)) * gaussian(random);
  }
  /// What a counter shows: whole ticks, of a wheel that stood at the edge of one at the start.
  [[nodiscard]] double count(double travel_m) const {
    const double ticks = std::floor(travel_m * ticks_per_metre_);
    return full_ == 0 ? ticks : ticks - full_ * std::floor(ticks / full_);
  }

  double separation_m_ = 0;
  double scale_left_ = 1;
  double scale_right_ = 1;
  double ticks_per_metre_ = 0;
  double full_ = 0;  ///< Ticks after which a counter is 0 again; 0: never.
  double variance_per_metre_m_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_wheel_encoders") {
  rave::add_virtual_sensor<rave::VirtualWheelEncoders>(
      registry, {.name = "virtual_wheel_encoders",
                 .summary = "Ticks of the left and of the right wheel of a differential drive.",
                 .params = rave::kParams});
}
