// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "programs/testing/driver_harness.hpp"

namespace rave {
namespace {

class PedalsControllerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    driver.params.set("max_throttle", 0.5).set("watchdog_s", 0.4);
    driver.start();
  }
  Command answer(const Command& command, double age_s = 0) {
    ControlInput input;
    input.command = command;
    input.command_age_s = age_s;
    return driver.control(input);
  }

  testing::ControllerUnderTest driver{rave_register_plugin, "pedals"};
};

TEST_F(PedalsControllerTest, PassesPedalsOnWithinTheirRanges) {
  EXPECT_EQ(answer(pedals_command(-0.3, 0.4, 0.1, -1)), pedals_command(-0.3, 0.4, 0.1, -1));
  EXPECT_EQ(answer(pedals_command(7, 1, -3, 5)), pedals_command(1, 0.5, 0, 1));
  EXPECT_EQ(answer(pedals_command(-7, -1, 3, -0.1)), pedals_command(-1, 0, 1, -1));
}

TEST_F(PedalsControllerTest, BrakesWithoutAFreshAndFiniteCommand) {
  const Command brake = pedals_command(0, 0, 1, 1);
  EXPECT_EQ(answer({}), brake);
  EXPECT_EQ(answer(velocity_command(1, 0)), brake);
  EXPECT_EQ(answer(pedals_command(0, 0.4, 0, 1), 0.5), brake);
  EXPECT_EQ(answer(pedals_command(0, 0.4, 0, 1), 0.3), pedals_command(0, 0.4, 0, 1));
  EXPECT_EQ(answer(pedals_command(0, 0.4, 0, 1), std::numeric_limits<double>::quiet_NaN()), brake);
  EXPECT_EQ(answer(pedals_command(std::numeric_limits<double>::infinity(), 0, 0, 1)), brake);
}

}  // namespace
}  // namespace rave
