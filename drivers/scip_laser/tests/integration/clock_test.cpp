// SPDX-License-Identifier: Apache-2.0
#include "laser_bench.hpp"

namespace rave::scip {
namespace {

/// The offset in the report against what the peer's log says of its clock.
void expect_offset(const std::vector<std::string>& options, double start_s) {
  LaserBench bench(options);
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.sink->await_more(60);
  bench.driver.close();
  const auto all = bench.sent();
  const auto samples = bench.sink->samples();
  const auto matched = bench.match(all, samples);
  ASSERT_EQ(matched.size(), samples.size());
  // The timer as it would be without its turn.
  double timer_s = matched.back()->timer_ms * 1e-3;
  if (timer_s < start_s) timer_s += (1 << 24) * 1e-3;
  const double truth_s = static_cast<double>(matched.back()->measured_ns) * 1e-9 - timer_s;
  const auto report = bench.driver.report();
  std::printf("%s\n", report.dump().c_str());
  EXPECT_NEAR(report["clock_offset_s"].get<double>(), truth_s, 0.02);
  EXPECT_EQ(report["clock_restarts"], 0);
  const SimTime measured = bench.sink->clock().at_ns(matched.back()->measured_ns);
  EXPECT_NEAR((samples.back().stamp - measured).seconds(), 0, 0.02);
  EXPECT_EQ(bench.sink->queue().complaint(), "");
}

TEST(ScipLaserClock, OffAndDrifting) {
  expect_offset({"--clock-start-s", "3", "--drift-ppm", "200"}, 3);
}

TEST(ScipLaserClock, TheTimerTurnsOver) { expect_offset({"--clock-start-s", "16776.5"}, 16776); }

}  // namespace
}  // namespace rave::scip
