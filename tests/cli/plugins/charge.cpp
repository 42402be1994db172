// SPDX-License-Identifier: Apache-2.0
// A program that overloads the process that it runs in, as many robots would. Not installed.
#include <algorithm>
#include <ctime>
#include <optional>

#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("speed_mps", "m/s", 0, 0, 10, "Straight on, if it has wheels."),
    number_param("stop_m", "m", 0, 0, 100, "It stands when a ray is shorter; 0: it does not look."),
    number_param("burn_ms", "ms", 0, 0, 10'000, "Time of a core that each decision takes."),
    number_param("from_x_m", "m", -1e6, -1e6, 1e6, "Once the robot has been beyond this."),
};

std::int64_t used_ns() {
  std::timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

/// Drives straight on, and thinks for long when it has come far enough.
class Charge final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    const Params params = setup.params();
    speed_mps_ = params.number("speed_mps");
    stop_m_ = static_cast<float>(params.number("stop_m"));
    burn_ns_ = static_cast<std::int64_t>(params.number("burn_ms") * 1e6);
    from_x_m_ = params.number("from_x_m");
    if (speed_mps_ > 0) {
      RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    }
    if (stop_m_ > 0) {
      RAVE_TRY_ASSIGN(laser_, setup.sensor<float>());
    }
    return {};
  }

  void decide(const Percepts& percepts, Commands& commands) override {
    far_ = far_ || percepts.pose().x_m > from_x_m_;
    const std::int64_t until_ns = used_ns() + (far_ ? burn_ns_ : 0);
    while (used_ns() < until_ns) continue;
    if (speed_mps_ <= 0) return;
    bool near = false;
    if (laser_) {
      near = std::ranges::any_of(percepts[*laser_], [this](float m) { return m < stop_m_; });
    }
    commands.velocity(drive_, near ? 0 : speed_mps_, 0);
  }

 private:
  ControllerHandle drive_;
  std::optional<SensorHandle<float>> laser_;
  double speed_mps_ = 0;
  float stop_m_ = 0;
  std::int64_t burn_ns_ = 0;
  double from_x_m_ = 0;
  bool far_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("charge") {
  rave::add_program<rave::Charge>(
      registry, {.name = "charge", .summary = "Overloads its process.", .params = rave::kParams});
}
