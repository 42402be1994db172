// SPDX-License-Identifier: Apache-2.0
// A vehicle after Braitenberg: two light sensors, and it turns to the brighter side.
#include <algorithm>
#include <rave/robot/plugin_entry.hpp>

namespace {

class SeekLight final : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    RAVE_TRY_ASSIGN(left_, setup.sensor<double>("left_eye"));
    RAVE_TRY_ASSIGN(right_, setup.sensor<double>("right_eye"));
    RAVE_TRY_ASSIGN(drive_, setup.controller(rave::CommandKind::kVelocity));
    return {};
  }

  void decide(const rave::Percepts& percepts, rave::Commands& commands) override {
    const auto left = percepts[left_];
    const auto right = percepts[right_];
    if (left.empty() || right.empty()) return;  // No sample yet.
    const double sum = left[0] + right[0];
    if (sum > 1.2) return commands.velocity(drive_, 0, 0);           // At the lamp.
    const double turn = sum > 0 ? (left[0] - right[0]) / sum : 1.0;  // Dark: turn and search.
    commands.velocity(drive_, sum > 0 ? 0.25 : 0.0, std::clamp(3 * turn, -1.0, 1.0));
  }

 private:
  rave::SensorHandle<double> left_, right_;
  rave::ControllerHandle drive_;
};

}  // namespace

RAVE_PLUGIN("seek_light") {
  rave::add_program<SeekLight>(registry,
                               {.name = "seek_light", .summary = "Drives to the brighter side."});
}
