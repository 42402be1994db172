// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include "rave/math/exponential.hpp"
#include "rave/math/gaussian.hpp"
#include "rave/math/geodesy.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr std::size_t kNumbersPerRegion = 3;

constexpr ParamSpec kParams[] = {
    number_param("latitude_deg", "deg", 52.5, -90, 90, "Latitude of the origin of the world."),
    number_param("longitude_deg", "deg", 13.4, -180, 180, "Longitude of the origin of the world."),
    number_param("x_axis_deg", "deg", 0, -360, 360,
                 "Direction of the world's x axis, counter-clockwise from east."),
    number_param("noise_m", "m", 0.3, 0, 1000,
                 "Standard deviation of the noise of each fix, east and north."),
    number_param("multipath_m", "m", 1.5, 0, 1000,
                 "Standard deviation of the slow error from reflected signals, east and north."),
    number_param("multipath_s", "s", 60, 0.001, 1e6,
                 "Time in which the slow error forgets 63 per cent of itself."),
    numbers_param("shadows", "m", -1e6, 1e6,
                  "Regions without a fix, three numbers each: x and y of the middle, radius."),
};

/// A circle in which no satellite is seen.
struct Shadow {
  Vec2 p_W;
  double radius_m = 0;
};

/// A satellite receiver: latitude and longitude with a white and a slow error.
class VirtualGps final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;

  struct State {
    bool started = false;
    Vec2 slow_W_m;
  };

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    earth_ = GeoFrame({params.number("latitude_deg"), params.number("longitude_deg"), 0},
                      deg_to_rad(params.number("x_axis_deg")));
    noise_m_ = params.number("noise_m");
    multipath_m_ = params.number("multipath_m");
    multipath_s_ = params.number("multipath_s");
    declaration.capacity = 3;
    return read_shadows(params.numbers("shadows"));
  }

  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    State& state = *static_cast<State*>(item.state);
    RandomStream random = item.random();
    wander(state, item.elapsed_s, random);
    const double east_m = noise_m_ * gaussian(random);
    const double north_m = noise_m_ * gaussian(random);
    const Vec2 p_W = item.X_WS.position();
    for (const Shadow& shadow : shadows_) {
      if (squared_norm(p_W - shadow.p_W) < shadow.radius_m * shadow.radius_m) {
        item.header->count = 0;
        return;
      }
    }
    const GeoPoint place = earth_.place(
        {p_W.x + state.slow_W_m.x + east_m, p_W.y + state.slow_W_m.y + north_m, item.z_m});
    auto* const values = static_cast<double*>(item.records);
    values[0] = place.latitude_deg;
    values[1] = place.longitude_deg;
    values[2] = std::sqrt(noise_m_ * noise_m_ + multipath_m_ * multipath_m_);
    item.header->count = 3;
  }

 private:
  /// A random walk that is drawn back to 0, so that its spread stays the same.
  void wander(State& state, double elapsed_s, RandomStream& random) const {
    const Vec2 step{multipath_m_ * gaussian(random), multipath_m_ * gaussian(random)};
    if (!state.started) {
      state.started = true;
      state.slow_W_m = step;
      return;
    }
    const double keeps = exp(-elapsed_s / multipath_s_);
    state.slow_W_m = keeps * state.slow_W_m + std::sqrt(1 - keeps * keeps) * step;
  }

  Status read_shadows(std::span<const double> numbers) {
    if (numbers.size() % kNumbersPerRegion != 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "`shadows` has {} numbers; expected three for each region: x, y, radius",
                  numbers.size());
    }
    for (; !numbers.empty(); numbers = numbers.subspan(kNumbersPerRegion)) {
      shadows_.push_back({{numbers[0], numbers[1]}, numbers[2]});
    }
    return {};
  }

  GeoFrame earth_{{}};
  double noise_m_ = 0;
  double multipath_m_ = 0;
  double multipath_s_ = 1;
  std::vector<Shadow> shadows_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_gps") {
  rave::add_virtual_sensor<rave::VirtualGps>(
      registry, {.name = "virtual_gps",
                 .summary = "Latitude and longitude in deg, and the standard deviation in m; no "
                            "values without a fix.",
                 .params = rave::kParams});
}
