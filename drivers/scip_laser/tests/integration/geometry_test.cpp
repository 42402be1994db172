// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "laser_bench.hpp"

namespace rave::scip {
namespace {

/// Distance from (1.2, 0.9) to the walls of the peer's room, by the slabs of its two boxes.
double room_m(double direction) {
  const double x = 1.2;
  const double y = 0.9;
  const double dx = std::cos(direction);
  const double dy = std::sin(direction);
  const double to_x = dx > 0 ? (4 - x) / dx : -x / dx;
  const double to_y = dy > 0 ? (3 - y) / dy : -y / dy;
  double distance = std::min(to_x, to_y);
  const double door_y = y + to_x * dy;
  if (dx > 0 && to_x < to_y && door_y > 1 && door_y < 1.8) {
    distance = std::numeric_limits<double>::infinity();
  }
  const double enter = std::max((2.5 - x) / dx, (1.9 - y) / dy);
  const double leave = std::min((2.9 - x) / dx, (2.3 - y) / dy);
  return dx > 0 && dy > 0 && enter < leave ? std::min(distance, enter) : distance;
}

void expect_room(const LaserBench& bench) {
  const HardwareDeclaration& declared = bench.driver.declaration();
  const auto samples = bench.sink->samples();
  ASSERT_FALSE(samples.empty());
  int none = 0;
  int edges = 0;
  for (std::uint32_t i = 0; i < declared.capacity; ++i) {
    const double direction = 0.3 + declared.bearings_rad[i];
    const double truth = room_m(direction);
    const double measured = static_cast<double>(samples.back().records[i]);
    // At an edge a ray may fall on either side of it.
    const double beside = room_m(direction + 1e-9);
    if (std::isinf(truth) != std::isinf(measured) || std::isinf(beside) != std::isinf(truth)) {
      ++edges;
    } else if (std::isinf(truth)) {
      ++none;
    } else {
      EXPECT_NEAR(measured, truth, 0.031) << i;  // six times the noise, and a millimetre
    }
  }
  EXPECT_GT(none, 20) << "the door";
  EXPECT_LE(edges, 0);
}

TEST(ScipLaser, RangesAreTheRoom) {
  LaserBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  const HardwareDeclaration& declared = bench.driver.declaration();
  EXPECT_EQ(declared.capacity, 682U);
  EXPECT_EQ(declared.clock, DriverClock::kLive);
  EXPECT_DOUBLE_EQ(declared.range_min_m, 0.020);
  EXPECT_DOUBLE_EQ(declared.range_max_m, 5.600);
  EXPECT_DOUBLE_EQ(declared.bearings_rad[0], (44 - 384) * 2 * std::numbers::pi / 1024);
  expect_room(bench);
  bench.sink->await_more(100);
  bench.driver.close();
  const auto all = bench.sent();
  const auto samples = bench.sink->samples();
  const auto matched = bench.match(all, samples);
  std::vector<double> times_ms;
  for (std::size_t i = 0; i < matched.size(); ++i) {
    const auto measured = bench.sink->clock().at_ns(matched[i]->measured_ns);
    times_ms.push_back((samples[i].published - measured).seconds() * 1e3);
    EXPECT_LE(samples[i].stamp, samples[i].published);
  }
  testing::print_times("scan at the line to published", times_ms);
  EXPECT_EQ(bench.sink->queue().complaint(), "");
  EXPECT_EQ(bench.sink->queue().failure(), "");
}

TEST(ScipLaser, OverTcp) {
  LaserBench bench({}, true);
  ASSERT_NO_FATAL_FAILURE(bench.start());
  expect_room(bench);
}

TEST(ScipLaser, PolledWithTwoCharactersAndFewerSteps) {
  LaserBench bench;
  bench.given["mode"] = "polled";
  bench.given["characters"] = "two";
  bench.given["first_step"] = 300.0;
  bench.given["last_step"] = 301.0;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.sink->await_more(20);
  EXPECT_EQ(bench.driver.declaration().capacity, 2U);
  EXPECT_DOUBLE_EQ(bench.driver.declaration().range_max_m, 4.094);
  EXPECT_DOUBLE_EQ(bench.driver.declaration().bearings_rad[1],
                   (301 - 384) * 2 * std::numbers::pi / 1024);
  for (const auto& sample : bench.sink->samples()) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      const double truth = room_m(0.3 + bench.driver.declaration().bearings_rad[i]);
      EXPECT_NEAR(static_cast<double>(sample.records[i]), truth, 0.031);
    }
  }
}

TEST(ScipLaser, ResetOpensAgain) {
  LaserBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.driver.close();
  testing::LiveSink<float> again(ReadingKind::kRanges, bench.driver.declaration().capacity);
  ASSERT_EQ(bench.driver.open(again), "");
  again.await_more(3);
  EXPECT_EQ(bench.driver.open(again), "opened twice; close it first");
  bench.driver.close();
}

}  // namespace
}  // namespace rave::scip
