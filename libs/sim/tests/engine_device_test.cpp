// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "rave/sim_testing/engine_fixture.hpp"
#include "rave/sim_testing/given.hpp"

namespace rave::sim::testing {
namespace {

using Lines = std::vector<std::string>;

/// What the instances of this file write down; plug-ins are given nothing of a test's.
struct Notebook {
  Lines lines;
  SampleSink* sink = nullptr;
  bool motor_fails = false;
  std::vector<HardwareDevice*> devices;

  Lines take() { return std::exchange(lines, {}); }
};
Notebook* notebook = nullptr;

void jot(const std::string& line) { notebook->lines.push_back(line); }

class Base final : public HardwareDevice {
 public:
  Status configure(const HardwareDeviceSetup& setup) override {
    broken_ = (given(setup.parameters(), "broken") != 0);
    jot("base configured");
    return {};
  }
  Status open() override {
    jot("base opened");
    if (broken_) return fail(ErrorCode::kIo, "no cable");
    return {};
  }
  void close() override { jot("base closed"); }
  [[nodiscard]] std::string report() const override { return R"({"volts":12})"; }

 private:
  bool broken_ = false;
};

class Part final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kValues;
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    jot("part configured");
    notebook->devices.push_back(setup.device);
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink& sink) override {
    jot("part opened");
    notebook->sink = &sink;
    return {};
  }
  void close() override { jot("part closed"); }
};

class Motor final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status open(const DeviceSetup& setup) override {
    jot("motor opened");
    notebook->devices.push_back(setup.device);
    return {};
  }
  Status write(const Command& /*command*/, SimTime /*now*/) override {
    if (notebook->motor_fails) return fail(ErrorCode::kIo, "no power");
    return {};
  }
  void close() override { jot("motor closed"); }
};

class EngineDevices : public ::testing::Test {
 public:
  EngineDevices() { notebook = &notebook_; }
  ~EngineDevices() override { notebook = nullptr; }

 protected:
  /// A simulated body that carries a device with a part and, if wanted, a motor.
  EngineSpec spec_with(bool broken = false) {
    static constexpr HardwareDeviceOps kBase = detail::hardware_device_ops<Base>();
    static constexpr HardwareActuatorOps kMotor = detail::hardware_actuator_ops<Motor>();
    RobotType type = simulated_type();
    DeviceSpec device;
    device.name = "base";
    device.driver = "base_driver";
    device.ops = &kBase;
    device.params = numbers({{"broken", broken ? 1.0 : 0.0}});
    type.devices.push_back(std::move(device));
    SensorSpec part = real_sensor<Part>("part", {});
    part.device = 0;
    type.sensors.push_back(std::move(part));
    ActuatorSpec motor;
    motor.name = "motor";
    motor.driver = "motor_driver";
    motor.hardware_ops = &kMotor;
    motor.device = 0;
    type.actuators.push_back(std::move(motor));
    type.controllers[0].actuator = 1;
    type.program = program<Drive>({{"v", 1}});
    EngineSpec spec;
    spec.live_clock = &clock_;
    spec.on_ready = [] { jot("ready"); };
    add_robot(spec, std::move(type));
    return spec;
  }

  ClockAtZero clock_;
  Notebook notebook_;
};

TEST_F(EngineDevices, OpenBeforeAndCloseAfterWhatIsPartOfThem) {
  auto engine = make_engine(spec_with());
  const Lines opened{"base opened", "motor opened", "ready", "part opened"};
  Lines made{"base configured", "part configured"};
  made.insert(made.end(), opened.begin(), opened.end());
  EXPECT_EQ(notebook_.take(), made);
  ASSERT_TRUE(engine->reset());
  const Lines closed{"part closed", "motor closed", "base closed"};
  Lines again = closed;
  again.insert(again.end(), opened.begin(), opened.end());
  EXPECT_EQ(notebook_.take(), again);
  engine.reset();
  EXPECT_EQ(notebook_.take(), closed);
}

TEST_F(EngineDevices, EachRobotHasItsOwn) {
  EngineSpec spec = spec_with();
  add_twin(spec, {5, 0, 0});
  const auto engine = make_engine(std::move(spec));
  ASSERT_EQ(notebook_.devices.size(), 4U);  // two parts, then two motors
  EXPECT_NE(notebook_.devices[0], nullptr);
  EXPECT_NE(notebook_.devices[0], notebook_.devices[1]);
  EXPECT_EQ(notebook_.devices[2], notebook_.devices[0]);
  EXPECT_EQ(notebook_.devices[3], notebook_.devices[1]);
  EXPECT_EQ(engine->device_report(RobotId(1), 0), R"({"volts":12})");
}

TEST_F(EngineDevices, AnErrorNamesTheDeviceAndItIsClosed) {
  const auto engine = Engine::create(spec_with(true));
  ASSERT_FALSE(engine.has_value());
  EXPECT_EQ(engine.error().text(), "robot `r0`, device `base` (driver `base_driver`): no cable");
  EXPECT_EQ(notebook_.take(),
            (Lines{"base configured", "part configured", "base opened", "base closed"}));
}

TEST_F(EngineDevices, WhatFailsAndComesBackIsToldOnceEach) {
  const auto engine = make_engine(spec_with());
  EXPECT_TRUE(run(*engine, 3).empty());
  notebook_.sink->fail("cable pulled", 12);
  notebook_.motor_fails = true;
  auto events = run(*engine, 3);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverFailed);
  EXPECT_EQ(events[0].text, "actuator `motor`: no power");
  EXPECT_EQ(events[1].kind, EventKind::kDriverFailed);
  EXPECT_EQ(events[1].text, "sensor `part`: cable pulled");
  notebook_.sink->recover();
  notebook_.motor_fails = false;
  events = run(*engine, 3);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverBack);
  EXPECT_EQ(events[0].text, "actuator `motor`: works again");
  EXPECT_EQ(events[1].text, "sensor `part`: works again");
  notebook_.sink->fail("cable pulled again", 18);
  events = run(*engine, 3);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "sensor `part`: cable pulled again");
}

}  // namespace
}  // namespace rave::sim::testing
