// SPDX-License-Identifier: Apache-2.0
// A message model: the probability of loss grows with the square of the distance.
#include <algorithm>
#include <rave/robot/plugin_entry.hpp>

namespace {

class Fading final : public rave::Communicator {
 public:
  rave::Status start(const rave::DeviceSetup& setup, rave::RadioDeclaration& declaration) override {
    range_m_ = setup.parameters().number("range_m");
    declaration.range_m = range_m_;  // The host asks link() only for robots within.
    return {};
  }

  [[nodiscard]] rave::LinkAnswer link(const rave::LinkQuery& query) const override {
    const double ratio = query.distance_m / range_m_;
    // Drawn from the numbers of this delivery: the same in every run with the same seed.
    rave::RandomStream random = query.random();
    rave::LinkAnswer answer;
    answer.arrives = random.uniform() < ratio * ratio ? 0 : 1;
    answer.delay_s = 0.01;
    return answer;
  }

 private:
  double range_m_ = 0;
};

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("range_m", "m", 10, 0.1, 1e6, "Distance at which every message is lost."),
};

}  // namespace

RAVE_PLUGIN("fading") {
  rave::add_communicator<Fading>(
      registry, {.name = "fading", .summary = "Loss grows with the distance.", .params = kParams});
}
