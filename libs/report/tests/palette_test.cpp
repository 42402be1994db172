// SPDX-License-Identifier: Apache-2.0
#include "rave/report/palette.hpp"

#include <gtest/gtest.h>

#include <set>

namespace rave::report {
namespace {

TEST(Palette, EveryKindHasItsOwnColourAndName) {
  std::set<std::string_view> colours;
  std::set<std::string_view> names;
  for (const Kind kind : kAllKinds) {
    const KindStyle style = palette_for(kind);
    EXPECT_EQ(style.colour.size(), 7U);
    EXPECT_EQ(style.colour.front(), '#');
    colours.insert(style.colour);
    names.insert(style.singular);
    names.insert(style.plural);
  }
  EXPECT_EQ(colours.size(), kAllKinds.size());
  EXPECT_EQ(names.size(), 2 * kAllKinds.size());
}

TEST(Palette, RecordedRobotsDifferAndRepeat) {
  std::set<std::string_view> colours;
  for (std::size_t i = 0; i < 5; ++i) colours.insert(robot_colour(i));
  EXPECT_EQ(colours.size(), 5U);
  EXPECT_EQ(robot_colour(5), robot_colour(0));
  EXPECT_EQ(colours.count(palette_for(Kind::kVirtualObstacle).colour), 0U);
}

}  // namespace
}  // namespace rave::report
