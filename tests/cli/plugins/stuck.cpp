// SPDX-License-Identifier: Apache-2.0
// Drivers of a real robot of which one never opens. Not installed.
#include <atomic>

#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

/// As one that asks a device which does not answer.
class StuckPose final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    host_ = setup.host;
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink&) override {
    host_.write(LogLevel::kInfo, "the device does not answer");
    static std::atomic<bool> answered = false;
    answered.wait(false);
    return {};
  }
  void close() override {}

 private:
  HostServices host_;
};

class StillWheels final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status open(const DeviceSetup&) override { return {}; }
  Status write(const Command&, SimTime) override { return {}; }
  void close() override {}
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("stuck_pose still_wheels") {
  rave::add_sensor<rave::StuckPose>(registry, {.name = "stuck_pose", .summary = "Never opens."});
  rave::add_actuator<rave::StillWheels>(registry,
                                        {.name = "still_wheels", .summary = "Do not turn."});
}
