// SPDX-License-Identifier: Apache-2.0
#include "rave/math/transform.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave {
namespace {

/// A bumper around the whole body: reports whether it touches anything, and on which side.
class VirtualContact final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kContact;

  Status configure(const VirtualSensorSetup& /*setup*/,
                   VirtualDeclaration& /*declaration*/) override {
    return {};
  }

  void sample(const WorldView& world, const SampleItem& item) const override {
    const TouchState touch = world.touch(item.robot);
    auto& reading = *static_cast<ContactReading*>(item.records);
    reading = {};
    if (touch.touching) {
      const Vec2 direction_R = rotate_back(sincos(item.X_WR.yaw), touch.direction_W);
      reading.touching = 1;
      reading.bearing_rad = static_cast<float>(atan2(direction_R.y, direction_R.x));
    }
    item.header->count = 1;
  }
};

}  // namespace
}  // namespace rave

RAVE_VIRTUAL_PLUGIN("virtual_contact") {
  rave::add_virtual_sensor<rave::VirtualContact>(
      registry, {.name = "virtual_contact",
                 .summary = "Whether the robot's body touches anything, and on which side."});
}
