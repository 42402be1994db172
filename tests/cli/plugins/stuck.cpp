// SPDX-License-Identifier: Apache-2.0
// Drivers of a real robot of which one never opens and one never closes. Not installed.
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

/// As one whose device has gone while it waits for the last word of it.
class EndlessPose final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink& sink) override {
    const PoseReading pose{};
    static_cast<void>(sink.publish(sink.now(), &pose, 1));
    return {};
  }
  void close() override {
    static std::atomic<bool> said_so = false;
    said_so.wait(false);
  }
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

RAVE_PLUGIN("stuck_pose endless_pose still_wheels") {
  rave::add_sensor<rave::StuckPose>(registry, {.name = "stuck_pose", .summary = "Never opens."});
  rave::add_sensor<rave::EndlessPose>(registry,
                                      {.name = "endless_pose", .summary = "Never closes."});
  rave::add_actuator<rave::StillWheels>(registry,
                                        {.name = "still_wheels", .summary = "Do not turn."});
}
