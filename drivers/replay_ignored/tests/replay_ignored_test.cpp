// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/driver_harness.hpp"

namespace rave {
namespace {

using Device = testing::DeviceUnderTest<HardwareActuatorOps, DriverKind::kActuator>;

TEST(ReplayIgnored, LogsTheFirstCommandAndThenOneLineAMinute) {
  Device driver(rave_register_plugin, "replay_ignored");
  const DeviceSetup setup = driver.setup();
  ErrorText error;
  ASSERT_EQ(driver.ops().open(driver.instance(), &setup, &error), 0) << error.text;

  const Command nothing;
  EXPECT_EQ(driver.ops().write(driver.instance(), &nothing, 0, &error), 0);
  EXPECT_TRUE(driver.log.lines.empty());

  const Command command = velocity_command(0.25, -0.5);
  for (int step = 0; step <= 15'000; ++step) {  // 5 s to 155 s
    const std::int64_t now_ns = 5'000'000'000 + step * 10'000'000LL;
    ASSERT_EQ(driver.ops().write(driver.instance(), &command, now_ns, &error), 0) << error.text;
  }
  ASSERT_EQ(driver.log.lines.size(), 3U);
  EXPECT_NE(driver.log.lines[0].find("v = 0.25 m/s, w = -0.5 rad/s) at 5.000 s is ignored"),
            std::string::npos)
      << driver.log.lines[0];
  EXPECT_EQ(driver.log.lines[1], "6001 commands ignored up to 65.000 s");
  EXPECT_EQ(driver.log.lines[2], "12001 commands ignored up to 125.000 s");
  driver.ops().close(driver.instance());

  // A reset of the run begins anew.
  ASSERT_EQ(driver.ops().open(driver.instance(), &setup, &error), 0);
  ASSERT_EQ(driver.ops().write(driver.instance(), &command, 0, &error), 0);
  EXPECT_EQ(driver.log.lines.size(), 4U);
}

TEST(ReplayIgnored, SaysThatItDoesNotObey) {
  Device driver(rave_register_plugin, "replay_ignored");
  EXPECT_EQ(driver.ops().obeys(driver.instance()), 0);
  EXPECT_EQ(driver.info().data_kind, static_cast<std::uint32_t>(CommandKind::kVelocity));
}

}  // namespace
}  // namespace rave
