// SPDX-License-Identifier: Apache-2.0
#include "label_placer.hpp"

#include <gtest/gtest.h>

namespace rave::report {
namespace {

constexpr PageBox kArea = {0, 0, 100, 100};

TEST(LabelPlacer, PrefersTheRight) {
  LabelPlacer placer(kArea);
  const auto box = placer.place({50, 50}, 20, 8, 3);
  ASSERT_TRUE(box);
  EXPECT_GE(box->x0, 53 - 1e-9);
}

TEST(LabelPlacer, NeverOverlapsNorLeavesTheArea) {
  LabelPlacer placer(kArea);
  std::vector<PageBox> placed;
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10;
    const auto box = placer.place({5.0 + 9 * (i % 10), 5.0 + 9 * row}, 16, 7, 2);
    if (!box) continue;
    EXPECT_TRUE(box->x0 >= 0 && box->y0 >= 0 && box->x1 <= 100 && box->y1 <= 100);
    for (const PageBox& other : placed) EXPECT_FALSE(box->overlaps(other));
    placed.push_back(*box);
  }
  EXPECT_GT(placed.size(), 20U);
  EXPECT_LT(placed.size(), 100U);
}

TEST(LabelPlacer, GivesUpWhereThereIsNoRoom) {
  LabelPlacer placer(kArea);
  placer.block(kArea);
  EXPECT_FALSE(placer.place({50, 50}, 20, 8, 3));
}

TEST(LabelPlacer, AvoidsLinesAndOtherThings) {
  LabelPlacer placer(kArea);
  for (double x = 52; x < 80; x += 1) placer.weigh({x, 50}, 4);
  const auto off_line = placer.place({50, 50}, 20, 8, 3);
  ASSERT_TRUE(off_line);
  EXPECT_FALSE(off_line->overlaps({52, 49.9, 80, 50.1}));

  LabelPlacer crowded(kArea);
  crowded.add_object({{50, 50}});
  crowded.add_object({{58, 50}});
  const auto box = crowded.place({50, 50}, 20, 8, 3);
  ASSERT_TRUE(box);
  EXPECT_LT(box->x0, 50);
}

// A wall from (10, 50) to (90, 50), 2 high: its label is beside its middle, not half its length
// away.
TEST(LabelPlacer, ALongObjectIsLabelledBesideIt) {
  const std::vector<Vec2> wall = {{50, 50}, {40, 50}, {60, 50}, {30, 50},
                                  {70, 50}, {20, 50}, {80, 50}};
  LabelPlacer placer(kArea);
  placer.block({10, 49, 90, 51});
  placer.add_object(wall);
  const auto box = placer.place(wall, 20, 8, 1);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->x0, 40, 1e-9);
  EXPECT_NEAR(box->y1, 49, 1e-9);
  // Where the middle is taken, it moves along the wall and stays beside it.
  LabelPlacer crowded(kArea);
  crowded.block({10, 49, 90, 51});
  crowded.block({35, 20, 65, 80});
  const auto moved = crowded.place(wall, 20, 8, 1);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->y1, 49, 1e-9);
  EXPECT_TRUE(moved->x1 <= 35 || moved->x0 >= 65);
}

}  // namespace
}  // namespace rave::report
