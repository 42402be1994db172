// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("cone_deg", "deg", 30, 0.1, 180, "Full opening angle of the cone."),
    number_param("resolution_deg", "deg", 1, 0.01, 180,
                 "Largest angle between neighbouring rays that sample the cone."),
    number_param("range_min_m", "m", 0.15, 0, 1000, "Smallest range; nearer bodies read as this."),
    number_param("range_max_m", "m", 6, 0, 1000, "Largest range; farther bodies give no return."),
};

/// An ultrasonic ranger: it declares rays across its cone, and the engine returns the minimum.
class VirtualSonar final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    spread(params.number("cone_deg"), params.number("resolution_deg"));
    declaration.uses_fan = 1;
    declaration.fan.bearings_rad = bearings_rad_.data();
    declaration.fan.ray_count = static_cast<std::uint32_t>(bearings_rad_.size());
    // All rays of the fan give one reading, their minimum: the first echo of the cone.
    declaration.fan.rays_per_reading = declaration.fan.ray_count;
    declaration.fan.range_min_m = params.number("range_min_m");
    declaration.fan.range_max_m = params.number("range_max_m");
    declaration.cone_rad = deg_to_rad(params.number("cone_deg"));
    declaration.reading_bearings_rad = &kAxis_rad;
    return {};
  }

 private:
  /// An even number of gaps, so that both edges and the axis of the cone have a ray.
  void spread(double cone_deg, double resolution_deg) {
    const double half_gaps = std::ceil(0.5 * cone_deg / resolution_deg);
    const auto rays = 2 * static_cast<std::size_t>(half_gaps) + 1;
    bearings_rad_.resize(rays);
    for (std::size_t i = 0; i < rays; ++i) {
      const double share = (static_cast<double>(i) - half_gaps) / half_gaps;
      bearings_rad_[i] = deg_to_rad(0.5 * cone_deg * share);
    }
  }

  static constexpr double kAxis_rad = 0;
  std::vector<double> bearings_rad_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_sonar") {
  rave::add_virtual_sensor<rave::VirtualSonar>(
      registry, {.name = "virtual_sonar",
                 .summary = "One range: the nearest body within the cone of an ultrasonic ranger.",
                 .params = rave::kParams});
}
