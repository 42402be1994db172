// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "rave/sim_testing/engine_fixture.hpp"

/// Robots with two sets of drivers, for tests of hand-overs.
namespace rave::sim::testing {

/// Gives the robot that was added last other drivers.
inline void add_drivers(EngineSpec& spec, RobotType type) {
  spec.robots.back().twin = static_cast<std::uint32_t>(spec.types.size());
  spec.types.push_back(std::move(type));
}

/// A simulated robot at the origin whose other drivers are real, with this source of its pose.
template <class Source>
RobotId add_simulated_or_real(EngineSpec& spec) {
  RobotType simulated = simulated_type();
  simulated.sensors.push_back(virtual_sensor<Beacon>("mocap"));
  RobotType real = real_type({});
  real.sensors.front() = real_sensor<Source>("mocap", {});
  const RobotId robot = add_robot(spec, std::move(simulated));
  add_drivers(spec, std::move(real));
  return robot;
}

/// A pose source that says what the test tells it, while it is open.
class Told final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  inline static std::atomic<SampleSink*> open_sink = nullptr;
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink& sink) override {
    open_sink = &sink;
    return {};
  }
  void close() override { open_sink = nullptr; }
};

}  // namespace rave::sim::testing
