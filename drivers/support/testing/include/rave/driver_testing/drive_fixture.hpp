// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>

#include "programs/testing/driver_harness.hpp"

namespace rave::testing {

/// A virtual drive of this plug-in, stepped each millisecond. Parameters are set before start().
class DriveTest : public ::testing::Test {
 protected:
  static constexpr double kDt_s = 0.001;

  explicit DriveTest(std::string_view name) : driver(rave_register_plugin, name) {
    driver.step_s = kDt_s;
  }
  /// The velocity of the body in the step with this number, in the frame of the robot.
  Twist2 step(const Command& command, std::uint32_t number = 0) {
    MotionInput input;
    input.command = command;
    input.dt_s = kDt_s;
    input.seed = 7;
    input.step = number;
    return driver.propose(input);
  }
  /// What a command leads to, as guards ask for it.
  Twist2 motion_of(const Command& command) {
    Twist2 motion;
    driver.ops().drive.motion(driver.instance(), &command, &motion);
    return motion;
  }
  /// The command that leads to this motion, as guards ask for it.
  Command command_for(const Twist2& motion) {
    Command command;
    driver.ops().drive.command(driver.instance(), &motion, &command);
    return command;
  }

  ActuatorUnderTest driver;
};

}  // namespace rave::testing
