// SPDX-License-Identifier: Apache-2.0
// What a device could not measure is not free space.
#include <algorithm>
#include <cmath>
#include <thread>

#include "laser_bench.hpp"

namespace rave::scip {
namespace {

/// The first sample in which every ray is `wanted`; waits for it.
template <class Wanted>
void await_all(LaserBench& bench, Wanted wanted) {
  while (true) {
    for (const auto& sample : bench.sink->samples()) {
      if (std::all_of(sample.records.begin(), sample.records.end(), wanted)) return;
    }
    bench.sink->await_more(1);
  }
}

TEST(ScipLaserCodes, AScanWithoutAnyRayIsNoSample) {
  LaserBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  for (const int code : {0, 3, 19}) {
    bench.peer->tell("blind " + std::to_string(code));
    const auto before = bench.driver.report()["blind"].get<int>();
    while (bench.driver.report()["blind"].get<int>() < before + 3) std::this_thread::yield();
  }
  bench.peer->tell("see");
  bench.sink->await_more(3);
  bench.driver.close();
  for (const auto& sample : bench.sink->samples()) {
    EXPECT_TRUE(std::any_of(sample.records.begin(), sample.records.end(),
                            [](float range_m) { return !std::isnan(range_m); }));
  }
  // The line was alive all the time.
  EXPECT_EQ(bench.driver.report()["connects"].get<int>(), 1);
}

TEST(ScipLaserCodes, NothingInReachIsFreeSpaceAndTooNearIsNot) {
  LaserBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.peer->tell("blind 1");
  await_all(bench, [](float range_m) { return std::isinf(range_m); });
  bench.peer->tell("blind 2");
  await_all(bench, [](float range_m) { return std::abs(range_m - 0.02F) < 1e-6F; });
}

TEST(ScipLaserCodes, OfAUrgNoCodeIsFreeSpace) {
  LaserBench bench({"--model", "URG-04LX(Hokuyo Automatic Co.,Ltd.)"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  const auto samples = bench.sink->samples();
  const auto& ranges_m = samples.front().records;
  EXPECT_GT(std::count_if(ranges_m.begin(), ranges_m.end(), [](float m) { return std::isnan(m); }),
            20)
      << "the door";
  for (const int code : {1, 2}) {
    bench.peer->tell("blind " + std::to_string(code));
    const auto before = bench.driver.report()["blind"].get<int>();
    while (bench.driver.report()["blind"].get<int>() < before + 3) std::this_thread::yield();
  }
}

}  // namespace
}  // namespace rave::scip
