// SPDX-License-Identifier: Apache-2.0
#include "rave/plugin/param_checks.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("range_min_m", "m", 0.1, 0, 1000, "Smallest range; nearer bodies read as this."),
    number_param("range_max_m", "m", 0.8, 0, 1000, "Largest range; farther bodies give no return."),
};

/// An infra-red ranger: one beam along the sensor's x axis, cast by the engine.
class VirtualInfrared final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;

  Status configure(const VirtualSensorSetup& setup, VirtualDeclaration& declaration) override {
    const Params params = setup.parameters();
    RAVE_TRY(check_ascending(params, "range_min_m", "range_max_m"));
    declaration.uses_fan = 1;
    declaration.fan.bearings_rad = &kAxis_rad;
    declaration.fan.ray_count = 1;
    declaration.fan.range_min_m = params.number("range_min_m");
    declaration.fan.range_max_m = params.number("range_max_m");
    return {};
  }

 private:
  static constexpr double kAxis_rad = 0;
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_infrared") {
  rave::add_virtual_sensor<rave::VirtualInfrared>(
      registry, {.name = "virtual_infrared",
                 .summary = "One short range along the narrow beam of an infra-red ranger.",
                 .params = rave::kParams});
}
