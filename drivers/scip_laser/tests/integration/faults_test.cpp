// SPDX-License-Identifier: Apache-2.0
// A bad cable: whatever it does to the bytes, no scan is delivered that the laser did not measure.
#include "laser_bench.hpp"

namespace rave::scip {
namespace {

void expect_no_wrong_scan(const std::string& fault) {
  LaserBench bench({"--seed", "5"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.sink->await_more(5);
  bench.peer->tell(fault + " 60");
  bench.peer->wait_for("spoilt");
  bench.sink->await_more(10);
  bench.driver.close();
  const auto all = bench.sent();
  const auto matched = bench.match(all, bench.sink->samples());
  ASSERT_EQ(matched.size(), bench.sink->samples().size());
  std::size_t spoilt = 0;
  for (const Sent& scan : all) spoilt += scan.fault == fault ? 1U : 0U;
  EXPECT_EQ(spoilt, 60U);
  std::size_t first = 0;
  while (all[first].fault != fault) ++first;
  std::size_t last = all.size() - 1;
  while (all[last].fault != fault) --last;
  std::size_t between = 0;
  for (const Sent* scan : matched) {
    between += scan > &all[first] && scan < &all[last] && scan->fault == "none" ? 1U : 0U;
  }
  EXPECT_GT(between, 5U) << "good scans go on between the bad";
  const auto report = bench.driver.report();
  std::printf("%s: %s\n", fault.c_str(), report.dump().c_str());
  const auto dropped = report["bad_checksum"].get<int>() + report["malformed"].get<int>();
  if (fault == "delay") {
    EXPECT_EQ(dropped, 0);
  } else {
    EXPECT_GT(dropped + report["repeated"].get<int>(), 20);
  }
  EXPECT_EQ(bench.sink->queue().complaint(), "");
}

TEST(ScipLaserFaults, Garbled) { expect_no_wrong_scan("garble"); }
TEST(ScipLaserFaults, Torn) { expect_no_wrong_scan("tear"); }
TEST(ScipLaserFaults, Repeated) { expect_no_wrong_scan("repeat"); }
TEST(ScipLaserFaults, Delayed) { expect_no_wrong_scan("delay"); }

}  // namespace
}  // namespace rave::scip
