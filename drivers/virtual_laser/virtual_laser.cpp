// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "rave/math/scalar.hpp"
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    integer_param("rays", 180, 1, 100000, "Number of rays, spread evenly over the field."),
    number_param("fov_deg", "deg", 180, 0, 360,
                 "Field of view, symmetric about the x axis of the sensor; 360: all around."),
    bool_param("rays_of_real_half", false,
               "In a hybrid sensor: use the rays of the real half and ignore `rays` and `fov_deg`. "
               "No effect elsewhere."),
    number_param("range_min_m", "m", 0.02, 0, 1000, "Smallest range; nearer bodies read as this."),
    number_param("range_max_m", "m", 8, 0, 1000, "Largest range; farther bodies give no return."),
};

/// A scanning laser: it declares its rays, and the engine casts them.
class VirtualLaser final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    const SensorInfo* const real = setup.real_half;
    if (params.flag("rays_of_real_half") && real != nullptr && real->bearings_rad != nullptr) {
      bearings_rad_.assign(real->bearings_rad, real->bearings_rad + real->capacity);
    } else {
      RAVE_TRY(spread(static_cast<std::size_t>(params.integer("rays")), params.number("fov_deg")));
    }
    declaration.uses_fan = 1;
    declaration.fan.bearings_rad = bearings_rad_.data();
    declaration.fan.ray_count = static_cast<std::uint32_t>(bearings_rad_.size());
    declaration.fan.range_min_m = params.number("range_min_m");
    declaration.fan.range_max_m = params.number("range_max_m");
    return {};
  }

 private:
  Status spread(std::size_t rays, double fov_deg) {
    if (rays > 1 && !(fov_deg > 0)) {
      return fail(ErrorCode::kInvalidArgument, "`fov_deg` is {}, so all {} `rays` coincide",
                  fov_deg, rays);
    }
    bearings_rad_.assign(rays, 0.0);
    if (rays == 1) return {};
    // A full circle has as many gaps as rays; otherwise the last ray would coincide with the first.
    const auto gaps = static_cast<double>(fov_deg < 360 ? rays - 1 : rays);
    for (std::size_t i = 0; i < rays; ++i) {
      bearings_rad_[i] = deg_to_rad(fov_deg * (static_cast<double>(i) / gaps - 0.5));
    }
    return {};
  }

  std::vector<double> bearings_rad_;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_laser") {
  rave::add_virtual_sensor<rave::VirtualLaser>(
      registry, {.name = "virtual_laser",
                 .summary = "Ranges to the nearest bodies along the rays of a scanning laser.",
                 .params = rave::kParams});
}
