// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "programs/testing/plugin_under_test.hpp"

namespace rave::testing {

/// One controller or actuator driver, called as the engine does.
template <class Ops, DriverKind kKind>
class DeviceUnderTest {
 public:
  DeviceUnderTest(RegisterPlugin register_plugin, std::string_view name)
      : plugin_(register_plugin, kKind, name), params(plugin_.info()), instance_(ops().instance) {}

  [[nodiscard]] const Ops& ops() const { return plugin_.template ops<Ops>(); }
  [[nodiscard]] const DriverInfo& info() const { return plugin_.info(); }
  [[nodiscard]] void* instance() const { return instance_.get(); }

  [[nodiscard]] DeviceSetup setup() {
    DeviceSetup setup;
    setup.robot.name = "robot";
    setup.host = log.host();
    setup.params = params.values().data();
    setup.param_count = params.values().size();
    setup.step_s = step_s;
    return setup;
  }
  void start() {
    const DeviceSetup device = setup();
    ErrorText error;
    ASSERT_EQ(ops().start(instance(), &device, &error), 0) << error.text;
  }

 private:
  PluginUnderTest plugin_;

 public:
  ParamSet params;
  LogLines log;
  double step_s = 0.01;

 private:
  Instance instance_;
};

class ControllerUnderTest : public DeviceUnderTest<ControllerOps, DriverKind::kController> {
 public:
  using DeviceUnderTest::DeviceUnderTest;

  Command control(const ControlInput& input) {
    Command output;
    std::uint8_t failed = 0;
    ErrorText error;
    ops().control(instance(), ops().instance.size, &input, &output, 1, &failed, &error);
    EXPECT_EQ(failed, 0) << error.text;
    return output;
  }
};

class ActuatorUnderTest : public DeviceUnderTest<VirtualActuatorOps, DriverKind::kVirtualActuator> {
 public:
  using DeviceUnderTest::DeviceUnderTest;

  Twist2 propose(const MotionInput& input) {
    Twist2 output;
    std::uint8_t failed = 0;
    ErrorText error;
    ops().propose(instance(), ops().instance.size, &input, &output, 1, &failed, &error);
    EXPECT_EQ(failed, 0) << error.text;
    return output;
  }
};

}  // namespace rave::testing
