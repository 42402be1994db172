// SPDX-License-Identifier: Apache-2.0
#include "rave/report/layout.hpp"

#include <gtest/gtest.h>

#include "sample_picture.hpp"

namespace rave::report {
namespace {

Picture world_of(double width_m, double height_m, bool with_instant) {
  Picture picture;
  picture.tracks.push_back({"", Kind::kSimulatedRobot, "", {}, {}, false, {}});
  picture.tracks[0].points = {{0, {0, 0, 0}}, {1, {width_m, height_m, 0}}};
  if (with_instant) picture.instant.emplace();
  return picture;
}

TEST(Layout, TallWorldsStandSideBySideAndWideOnesOneAboveTheOther) {
  const auto tall = lay_out(world_of(7, 12, true)).value().panels;
  ASSERT_EQ(tall.size(), 2U);
  EXPECT_EQ(tall[0].frame.y0, tall[1].frame.y0);
  EXPECT_LT(tall[0].frame.x1, tall[1].frame.x0);
  const auto wide = lay_out(world_of(12, 5, true)).value().panels;
  EXPECT_EQ(wide[0].frame.x0, wide[1].frame.x0);
  EXPECT_LT(wide[0].frame.y1, wide[1].frame.y0);
  EXPECT_EQ(wide[0].units_per_m, wide[1].units_per_m);
}

TEST(Layout, OnePanelForTracksAlone) {
  const auto panels = lay_out(world_of(7, 12, false)).value().panels;
  ASSERT_EQ(panels.size(), 1U);
  EXPECT_EQ(panels[0].content, PanelContent::kTracks);
}

TEST(Layout, EverythingFitsWhateverTheShapeOfTheWorld) {
  for (const auto& [width_m, height_m] :
       {std::pair{7.0, 12.0}, {200.0, 1.0}, {1.0, 200.0}, {0.0, 0.0}, {1e6, 1e6}, {1e-3, 1e-3}}) {
    for (const bool with_instant : {false, true}) {
      const Layout layout = lay_out(world_of(width_m, height_m, with_instant)).value();
      for (const Panel& panel : layout.panels) {
        EXPECT_TRUE(panel.frame.contains(panel.to_page({0, 0})));
        EXPECT_TRUE(panel.frame.contains(panel.to_page({width_m, height_m})));
        EXPECT_GE(panel.frame.height(), 100);
        EXPECT_GE(panel.frame.x0, 0);
        EXPECT_LE(panel.frame.x1, layout.width);
        EXPECT_LE(panel.frame.y1, layout.legend.y0);
      }
      EXPECT_EQ(layout.width, 800);
      EXPECT_LT(layout.height, 1500);
    }
  }
}

TEST(Layout, ToPageIsAScaleWithYUp) {
  const Panel panel = lay_out(sample_picture()).value().panels[0];
  const Vec2 origin = panel.to_page({0, 0});
  const Vec2 one = panel.to_page({1, 2});
  EXPECT_NEAR(one.x - origin.x, panel.units_per_m, 1e-9);
  EXPECT_NEAR(origin.y - one.y, 2 * panel.units_per_m, 1e-9);
}

TEST(Layout, NiceSteps) {
  for (const auto& [least_m, step_m] : {std::pair{1.0, 1.0},
                                        {1.1, 2.0},
                                        {2.1, 5.0},
                                        {5.1, 10.0},
                                        {0.3, 0.5},
                                        {0.04, 0.05},
                                        {730.0, 1000.0}}) {
    EXPECT_NEAR(nice_step_m(least_m), step_m, 1e-9 * step_m) << least_m;
  }
}

}  // namespace
}  // namespace rave::report
