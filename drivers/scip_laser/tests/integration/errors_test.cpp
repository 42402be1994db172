// SPDX-License-Identifier: Apache-2.0
#include "laser_bench.hpp"
#include "rave/base_testing/no_threads.hpp"

namespace rave::scip {
namespace {

std::string error_with(const Given& given) {
  testing::LiveDriver driver("scip_laser");
  return driver.configure(given);
}

TEST(ScipLaserErrors, NobodyAnswers) {
  EXPECT_EQ(error_with({{"device", "/dev/no-such-laser"}, {"start_timeout_s", 0.1}}),
            "no SCIP 2.0 device answered at `/dev/no-such-laser` within 0.1 s: cannot open "
            "`/dev/no-such-laser`: No such file or directory");
}

TEST(ScipLaserErrors, ParametersThatDoNotFit) {
  EXPECT_EQ(error_with({}),
            "give exactly one of `device` (a serial line) and `address` (host:port); there is "
            "none");
  LaserBench bench;
  bench.given["last_step"] = 726.0;
  EXPECT_EQ(bench.driver.configure(bench.given),
            "`first_step` 44 and `last_step` 726 do not lie within the device's 44 to 725");
}

TEST(ScipLaserErrors, WithoutAThreadItDoesNotOpenAndLaterItDoes) {
  LaserBench bench;
  ASSERT_EQ(bench.driver.configure(bench.given), "");
  testing::LiveSink<float> sink(ReadingKind::kRanges, bench.driver.declaration().capacity);
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(bench.driver.open(sink).find("cannot start the thread of the laser: "), 0U);
  }
  ASSERT_EQ(bench.driver.open(sink), "");
  sink.await_more(1);
  bench.driver.close();
}

TEST(ScipLaserErrors, OpenedTooEarly) {
  testing::LiveDriver driver("scip_laser");
  testing::LiveSink<float> sink(ReadingKind::kRanges, 1);
  EXPECT_EQ(driver.open(sink), "opened before it was configured");
  EXPECT_EQ(driver.report().dump(), "{}");
}

}  // namespace
}  // namespace rave::scip
