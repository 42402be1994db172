// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();

/// 40 x 20 cells of 0.1 m around the origin.
OccupancyGrid grid_of(const BeamModel& model = {}) {
  auto grid = OccupancyGrid::create({0.1, {-2, -1}, 40, 20}, model);
  EXPECT_TRUE(grid);
  return *std::move(grid);
}

TEST(OccupancyGrid, RefusesWhatIsNoGrid) {
  EXPECT_FALSE(OccupancyGrid::create({0.0, {}, 10, 10}, {}));
  EXPECT_FALSE(OccupancyGrid::create({0.1, {}, 0, 10}, {}));
  EXPECT_FALSE(OccupancyGrid::create({std::nan(""), {}, 10, 10}, {}));
  const auto huge = OccupancyGrid::create({0.1, {}, 100'000, 100'000}, {});
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message.find("100000 x 100000"), std::string::npos);
}

TEST(OccupancyGrid, OneBeamFreesItsWayAndMarksItsEnd) {
  OccupancyGrid grid = grid_of();
  const double bearing_rad = 0;
  const float range_m = 1.0F;
  grid.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&range_m, 1}});
  for (int column = 20; column < 30; ++column) {
    EXPECT_DOUBLE_EQ(grid.log_odds(column, 10), -0.4) << column;
  }
  EXPECT_DOUBLE_EQ(grid.log_odds(30, 10), 0.85);
  EXPECT_NEAR(grid.probability(30, 10), 1 / (1 + std::exp(-0.85)), 1e-12);
  EXPECT_FALSE(grid.seen(31, 10));
  EXPECT_FALSE(grid.seen(19, 10));
  EXPECT_FALSE(grid.seen(25, 11));
}

TEST(OccupancyGrid, NoReturnIsNoEndAndFreesOnlyWhatItIsToldTo) {
  const double bearing_rad = 0;
  OccupancyGrid silent = grid_of();
  silent.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&kNoReturn, 1}});
  EXPECT_FALSE(silent.seen(20, 10));
  OccupancyGrid told = grid_of({.no_return_free_m = 0.5});
  told.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&kNoReturn, 1}});
  EXPECT_LT(told.log_odds(24, 10), 0);
  EXPECT_FALSE(told.seen(26, 10));
}

TEST(OccupancyGrid, ALongBeamIsUsedUpToTheLimitOnly) {
  const double bearing_rad = 0;
  const float range_m = 1.5F;
  OccupancyGrid grid = grid_of({.range_max_m = 1.0});
  grid.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&range_m, 1}});
  EXPECT_LT(grid.log_odds(29, 10), 0);
  EXPECT_FALSE(grid.seen(35, 10)) << "no end";
}

TEST(OccupancyGrid, WithinOneScanACellCountsOnceAndAnEndWins) {
  // Two beams end in one cell, a third one passes through it.
  const double bearings_rad[] = {0.0, 0.01, -0.01};
  const float ranges_m[] = {1.0F, 1.0F, 1.5F};
  OccupancyGrid grid = grid_of();
  grid.add({{0.05, 0.05, 0}, bearings_rad, ranges_m});
  EXPECT_DOUBLE_EQ(grid.log_odds(30, 10), 0.85);
  EXPECT_DOUBLE_EQ(grid.log_odds(22, 10), -0.4);
}

TEST(OccupancyGrid, BeliefIsBoundedAndChanges) {
  const double bearing_rad = 0;
  const float near_m = 1.0F;
  const float far_m = 1.5F;
  OccupancyGrid grid = grid_of();
  for (int i = 0; i < 100; ++i) grid.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&near_m, 1}});
  EXPECT_DOUBLE_EQ(grid.log_odds(30, 10), 4.0);
  for (int i = 0; i < 30; ++i) grid.add({{0.05, 0.05, 0}, {&bearing_rad, 1}, {&far_m, 1}});
  EXPECT_DOUBLE_EQ(grid.log_odds(30, 10), -4.0) << "whoever stood there has left";
}

TEST(OccupancyGrid, WhatLeavesTheGridIsLeftOut) {
  const double bearings_rad[] = {0.0, kPi, kPi / 2, -kPi / 2};
  const float ranges_m[] = {100.0F, 100.0F, 100.0F, 100.0F};
  OccupancyGrid grid = grid_of({.range_max_m = 1000});
  grid.add({{0.05, 0.05, 0}, bearings_rad, ranges_m});
  EXPECT_LT(grid.log_odds(39, 10), 0);
  EXPECT_LT(grid.log_odds(0, 10), 0);
  EXPECT_LT(grid.log_odds(20, 19), 0);
  EXPECT_LT(grid.log_odds(20, 0), 0);
  grid.add({{50, 50, 0}, bearings_rad, ranges_m});
}

/// Every cell that a beam crosses by more than a hair is freed and no other one: against points
/// taken densely along the beam.
TEST(OccupancyGrid, TracesTheCellsThatTheBeamCrosses) {
  for (int k = 0; k < 360; ++k) {
    const double bearing_rad = k * kPi / 180 + 0.003;
    const float range_m = 0.83F;
    OccupancyGrid grid = grid_of({.log_odds_hit = 0});
    grid.add({{0.013, 0.027, 0}, {&bearing_rad, 1}, {&range_m, 1}});
    int wrong = 0;
    std::vector<int> crossed(800, 0);
    for (int i = 0; i < 8300; ++i) {
      const double x = (0.013 + i * 1e-4 * std::cos(bearing_rad) + 2) / 0.1;
      const double y = (0.027 + i * 1e-4 * std::sin(bearing_rad) + 1) / 0.1;
      ++crossed[static_cast<std::size_t>(y) * 40 + static_cast<std::size_t>(x)];
    }
    for (int row = 0; row < 20; ++row) {
      for (int column = 0; column < 40; ++column) {
        const int times =
            crossed[static_cast<std::size_t>(row) * 40 + static_cast<std::size_t>(column)];
        const bool seen = grid.seen(column, row);
        EXPECT_TRUE(seen || times <= 3) << k << ": " << column << ", " << row;
        // Only a corner that was cut, or the cell of the end.
        wrong += seen && times <= 3 ? 1 : 0;
      }
    }
    EXPECT_LE(wrong, 2) << k;
  }
}

TEST(OccupancyGrid, AConeFreesItsSectorAndSharesItsEndAlongTheArc) {
  OccupancyGrid grid = grid_of();
  const double cone_rad = 60 * kPi / 180;
  grid.add(ConeView{{0.05, 0.05, 0}, 0, cone_rad, 1.0});
  EXPECT_LT(grid.log_odds(25, 10), 0) << "on the axis";
  EXPECT_LT(grid.log_odds(25, 12), 0) << "beside it";
  EXPECT_GT(grid.log_odds(25, 12), grid.log_odds(25, 10)) << "off the axis it counts less";
  EXPECT_FALSE(grid.seen(25, 15)) << "outside of the cone";
  EXPECT_GT(grid.log_odds(30, 10), 0);
  EXPECT_GT(grid.log_odds(29, 14), 0) << "the arc has a bend";
  EXPECT_LT(grid.log_odds(30, 10), 0.5) << "which cell it was is not known";
  EXPECT_FALSE(grid.seen(32, 10)) << "behind the arc";
}

TEST(OccupancyGrid, ThePartOfAnArcThatIsKnownAsFreeGetsLittle) {
  const auto end_after = [](int beams) {
    OccupancyGrid grid = grid_of();
    const double bearings_rad[] = {0.0, 0.12, -0.12, 0.2, -0.2};
    const float ranges_m[] = {1.4F, 1.4F, 1.4F, 1.4F, 1.4F};
    for (int i = 0; i < beams; ++i) grid.add({{0.05, 0.05, 0}, bearings_rad, ranges_m});
    const double before = grid.log_odds(29, 14);
    grid.add(ConeView{{0.05, 0.05, 0}, 0, 60 * kPi / 180, 1.0});
    return grid.log_odds(29, 14) - before;
  };
  EXPECT_GT(end_after(6), 1.2 * end_after(0)) << "the edges must have given the echo";
}

TEST(OccupancyGrid, ANarrowConeIsARayAndNoReturnHasNoEnd) {
  OccupancyGrid narrow = grid_of();
  narrow.add(ConeView{{0.05, 0.05, 0}, 0, 0.01, 1.0});
  EXPECT_LT(narrow.log_odds(25, 10), 0);
  EXPECT_DOUBLE_EQ(narrow.log_odds(30, 10), 0.85);
  EXPECT_FALSE(narrow.seen(25, 12));
  OccupancyGrid silent = grid_of({.no_return_free_m = 0.5});
  silent.add(ConeView{{0.05, 0.05, 0}, 0, 0.5, std::numeric_limits<double>::infinity()});
  EXPECT_LT(silent.log_odds(23, 10), 0);
  EXPECT_FALSE(silent.seen(30, 10));
  silent.add(ConeView{{0.05, 0.05, 0}, 0, 0.5, std::nan("")});
  silent.add(ConeView{{1e300, 0, 0}, 0, 0.5, 1.0});
}

TEST(OccupancyGrid, TheDigestTellsMapsApart) {
  OccupancyGrid a = grid_of();
  OccupancyGrid b = grid_of();
  a.add(ConeView{{0.05, 0.05, 0}, 0, 0.5, 1.0});
  b.add(ConeView{{0.05, 0.05, 0}, 0, 0.5, 1.0});
  EXPECT_EQ(a.digest(), b.digest());
  b.add(ConeView{{0.05, 0.05, 0}, 0, 0.5, 1.1});
  EXPECT_NE(a.digest(), b.digest());
}

TEST(OccupancyGrid, SameScansSameBits) {
  const double bearings_rad[] = {-0.7, 0.1, 0.9};
  const float ranges_m[] = {0.9F, 1.3F, kNoReturn};
  OccupancyGrid a = grid_of();
  OccupancyGrid b = grid_of();
  for (int i = 0; i < 20; ++i) {
    a.add({{0.01 * i, 0, 0.1 * i}, bearings_rad, ranges_m});
    b.add({{0.01 * i, 0, 0.1 * i}, bearings_rad, ranges_m});
  }
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 40; ++column) {
      EXPECT_EQ(a.log_odds(column, row), b.log_odds(column, row));
    }
  }
}

}  // namespace
}  // namespace rave::estimate
