// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

/// Replaces the actuator of a recorded robot, which cannot be controlled.
class ReplayIgnored final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status open(const DeviceSetup& setup) override {
    host_ = setup.host;
    ignored_ = 0;
    return {};
  }

  Status write(const Command& command, SimTime now) override {
    // "No command" is nothing that could have been obeyed.
    if (command.kind == CommandKind::kNone) return {};
    ++ignored_;
    if (ignored_ == 1) {
      next_report_ = now + kReportPeriod;
      host_.write(LogLevel::kInfo,
                  fmt::format("the robot is recorded and ignores commands: the first command "
                              "(v = {} m/s, w = {} rad/s) at {:.3f} s is ignored",
                              command.value[0], command.value[1], now.seconds()));
    } else if (now >= next_report_) {
      next_report_ = now + kReportPeriod;
      host_.write(LogLevel::kInfo,
                  fmt::format("{} commands ignored up to {:.3f} s", ignored_, now.seconds()));
    }
    return {};
  }

  void close() override {}
  [[nodiscard]] bool obeys() const override { return false; }

 private:
  static constexpr Duration kReportPeriod = from_seconds(60);

  HostServices host_;
  std::uint64_t ignored_ = 0;
  SimTime next_report_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("replay_ignored") {
  rave::add_actuator<rave::ReplayIgnored>(
      registry,
      {.name = "replay_ignored",
       .summary =
           "The actuator of a recorded robot: accepts velocities, ignores them, and logs this."});
}
