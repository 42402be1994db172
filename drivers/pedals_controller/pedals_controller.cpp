// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("max_throttle", "", 1.0, 0, 1, "Largest share of the throttle."),
    number_param("watchdog_s", "s", 0.5, 0.001, 3600,
                 "Age of the last command after which it brakes."),
};

/// Passes pedals on within limits; brakes without a fresh and finite command.
class PedalsController final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kPedals;
  static constexpr CommandKind kGives = CommandKind::kPedals;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }

  Status parameters_changed(const Params& params) override {
    max_throttle_ = params.number("max_throttle");
    watchdog_s_ = params.number("watchdog_s");
    return {};
  }

  Command control(const ControlInput& input) override {
    const auto& value = input.command.value;
    const bool fresh = input.command.kind == kAccepts && input.command_age_s <= watchdog_s_;
    if (!fresh || !std::isfinite(value[0] + value[1] + value[2] + value[3])) return kBrake;
    return pedals_command(std::clamp(value[0], -1.0, 1.0), std::clamp(value[1], 0.0, max_throttle_),
                          std::clamp(value[2], 0.0, 1.0),
                          static_cast<double>((value[3] > 0) - (value[3] < 0)));
  }

 private:
  static constexpr Command kBrake = pedals_command(0, 0, 1, 1);

  double max_throttle_ = 1;
  double watchdog_s_ = 0;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("pedals") {
  rave::add_controller<rave::PedalsController>(
      registry, {.name = "pedals",
                 .summary = "Passes steering, throttle, brake and gear on; brakes without new "
                            "commands.",
                 .params = rave::kParams});
}
