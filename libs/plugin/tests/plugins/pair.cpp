// SPDX-License-Identifier: Apache-2.0
// A good plug-in with two drivers of different kinds.
#include <array>

#include "rave/robot/plugin_entry.hpp"

namespace {

class Sleeper final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup&) override { return {}; }
  void decide(const rave::Percepts&, rave::Commands&) override {}
};

constexpr std::array<const char*, 2> kModes{"deep", "light"};
constexpr std::array<rave::ParamSpec, 3> kParams{
    rave::number_param("nap_s", "s", 1.5, 0, 60, "How long it sleeps."),
    rave::choice_param("mode", "light", kModes, "How it sleeps."),
    rave::required(rave::text_param("bed", "", "Where it sleeps."))};
// The host under test never calls a sensor, so any address will do for its functions.
constexpr int kSensorOps = 0;

}  // namespace

RAVE_PLUGIN("sleeper ear") {
  const rave::Description sleeper{
      .name = "sleeper", .version = "1.0", .summary = "Sleeps where it stands.", .params = kParams};
  rave::add_program<Sleeper>(registry, sleeper);
  const rave::Description ear{.name = "ear", .version = "0.9", .summary = "Hears nothing."};
  registry.add(ear.info(rave::DriverKind::kSensor, 0), &kSensorOps);
}
