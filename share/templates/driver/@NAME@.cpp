// SPDX-License-Identifier: Apache-2.0
#include "@NAME@.hpp"

#include <cmath>

// Takes the parameters and says how many values a sample has.
rave::Status @CLASS@::configure(const rave::VirtualSensorSetup& setup,
                                rave::VirtualDeclaration& declaration) {
  p_WB_ = {setup.parameters().number("x_m"), setup.parameters().number("y_m")};
  declaration.capacity = 1;
  return {};
}

// One sample of one robot. The robot file adds latency, filters and drop-out. It adds no noise to a
// sensor of plain values: that would be here, `sigma * rave::gaussian(random)` with `auto random =
// item.random();` and <rave/math/gaussian.hpp>.
void @CLASS@::sample(const rave::WorldView& /*world*/, const rave::SampleItem& item) const {
  const double distance_m = std::sqrt(rave::squared_norm(p_WB_ - item.X_WS.position()));
  *static_cast<double*>(item.records) = distance_m;
  item.header->count = 1;
}

namespace {
constexpr rave::ParamSpec kParams[] = {
    rave::number_param("x_m", "m", 0, -1e4, 1e4, "Where the beacon stands, world frame."),
    rave::number_param("y_m", "m", 0, -1e4, 1e4, "Where the beacon stands, world frame."),
};
}  // namespace

RAVE_VIRTUAL_PLUGIN("@NAME@") {
  rave::add_virtual_sensor<@CLASS@>(
      registry, {.name = "@NAME@", .summary = "Distance to a beacon.", .params = kParams});
}
