// SPDX-License-Identifier: Apache-2.0
// A program that only listens: it logs when something comes near.
#include <fmt/format.h>

#include <optional>
#include <rave/math/scalar.hpp>
#include <rave/robot/plugin_entry.hpp>
#include <rave/robot/scan.hpp>

namespace {

class Alarm final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    setup_.emplace(setup);
    scan_ = rave::Scan(setup);
    near_m_ = setup.params().number("near_m");
    return {};
  }

  void decide(const rave::Percepts& percepts, rave::Commands& /*commands*/) override {
    scan_.update(percepts);
    const double ahead_m = scan_.nearest_m(rave::deg_to_rad(-20), rave::deg_to_rad(20));
    const bool near = ahead_m < near_m_;
    if (near && !was_near_) setup_->log(fmt::format("something is {:.2f} m ahead", ahead_m));
    was_near_ = near;
  }

 private:
  std::optional<rave::Setup> setup_;
  rave::Scan scan_;
  double near_m_ = 0;
  bool was_near_ = false;
};

constexpr rave::ParamSpec kParams[] = {
    rave::number_param("near_m", "m", 1.0, 0, 100, "Distance of the alarm."),
};

}  // namespace

RAVE_PLUGIN("alarm") {
  rave::add_program<Alarm>(
      registry, {.name = "alarm", .summary = "Logs what comes near.", .params = kParams});
}
