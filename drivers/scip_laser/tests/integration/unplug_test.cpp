// SPDX-License-Identifier: Apache-2.0
#include "laser_bench.hpp"

namespace rave::scip {
namespace {

void expect_comes_back(bool tcp) {
  LaserBench bench({}, tcp);
  bench.given["lost_after_s"] = 100.0;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  for (int times = 0; times < 2; ++times) {
    bench.peer->tell("vanish");
    bench.peer->tell("return");
    bench.sink->await_more(5);
  }
  EXPECT_EQ(bench.sink->queue().failure(), "") << "it was not away for long";
  bench.driver.close();
  EXPECT_GE(bench.driver.report()["connects"], 3);
  EXPECT_EQ(bench.match(bench.sent(), bench.sink->samples()).size(), bench.sink->samples().size());
  EXPECT_EQ(bench.sink->queue().complaint(), "");
}

TEST(ScipLaserUnplug, ComesBackAtTheTerminal) { expect_comes_back(false); }
TEST(ScipLaserUnplug, ComesBackOverTcp) { expect_comes_back(true); }

TEST(ScipLaserUnplug, AbsenceIsReportedAndEnds) {
  LaserBench bench;
  bench.given["lost_after_s"] = 0.3;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("vanish");
  const std::string why = bench.sink->await_failure();
  EXPECT_EQ(why.substr(0, why.find(':')),
            "the laser at `" + bench.link() + "` has been disconnected for more than 0.3 s");
  EXPECT_FALSE(bench.driver.report()["connected"]);
  bench.peer->tell("return");
  bench.sink->await_more(3);
  bench.sink->await_recovery();
  EXPECT_TRUE(bench.driver.report()["connected"]);
}

TEST(ScipLaserUnplug, SilenceIsNoticed) {
  LaserBench bench;
  bench.given["lost_after_s"] = 0.2;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("mute");
  const std::string why = bench.sink->await_failure();
  EXPECT_NE(why.find(": no valid scan for 0.5 s"), std::string::npos) << why;
  bench.peer->tell("speak");
  bench.sink->await_more(3);
}

TEST(ScipLaserUnplug, ClosesWhileTheDeviceIsAway) {
  LaserBench bench;
  bench.given["lost_after_s"] = 0.1;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("vanish");
  (void)bench.sink->await_failure();
  bench.driver.close();
}

}  // namespace
}  // namespace rave::scip
