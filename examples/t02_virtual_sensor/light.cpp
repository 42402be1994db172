// SPDX-License-Identifier: Apache-2.0
// A virtual sensor: the brightness of one lamp, with shadows.
#include <algorithm>
#include <cmath>
#include <rave/math/transform.hpp>
#include <rave/sim/virtual_sensor.hpp>

namespace {

class Light final : public rave::VirtualSensor {
 public:
  static constexpr rave::ReadingKind kReading = rave::ReadingKind::kValues;

  rave::Status configure(const rave::VirtualSensorSetup& setup,
                         rave::VirtualDeclaration& declaration) override {
    const rave::Params params = setup.parameters();
    p_WLamp_ = {params.number("lamp_x_m"), params.number("lamp_y_m")};
    layers_ = setup.layers;
    declaration.capacity = 1;  // One value per sample.
    return {};
  }

  // One object serves all robots, from several threads: const, and no allocation.
  void sample(const rave::WorldView& world, const rave::SampleItem& item) const override {
    const rave::BodyId own = world.body_of(item.robot);
    // The lamp in the frame of the sensor, which looks along its x axis.
    const rave::Vec2 p_SLamp = rave::transform_back(item.X_WS, p_WLamp_);
    const double distance_m = std::sqrt(rave::squared_norm(p_SLamp));
    const double facing = p_SLamp.x / std::max(distance_m, 1e-9);  // Cosine of the angle.
    const bool lit = world.visible(item.X_WS.position(), p_WLamp_, item.z_m, layers_, own, own);
    auto* const values = static_cast<double*>(item.records);
    values[0] = lit ? std::max(facing, 0.0) / (1 + distance_m * distance_m) : 0.0;
    item.header->count = 1;
  }

 private:
  rave::Vec2 p_WLamp_;
  rave::LayerMask layers_ = rave::kAllLayers;
};

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("lamp_x_m", "m", 0, -1000, 1000, "Position of the lamp in the world, x."),
    rave::number_param("lamp_y_m", "m", 0, -1000, 1000, "Position of the lamp in the world, y."),
};

}  // namespace

RAVE_VIRTUAL_PLUGIN("light") {
  rave::add_virtual_sensor<Light>(
      registry, {.name = "light", .summary = "Brightness of a lamp, 0 to 1.", .params = kParams});
}
