// SPDX-License-Identifier: Apache-2.0
#include "rave/base/names.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rave {
namespace {

TEST(EditDistance, CountsEachKindOfSlipOnce) {
  EXPECT_EQ(edit_distance("laser", "laser"), 0);
  EXPECT_EQ(edit_distance("laser", "lasr"), 1);
  EXPECT_EQ(edit_distance("laser", "lasser"), 1);
  EXPECT_EQ(edit_distance("laser", "lazer"), 1);
  EXPECT_EQ(edit_distance("laser", "alser"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(NearestName, FindsTheSlipAndOnlyThat) {
  constexpr std::array<std::string_view, 3> kNames = {"range_m", "period_s", "driver"};
  EXPECT_EQ(nearest_name("rnage_m", kNames), "range_m");
  EXPECT_EQ(nearest_name("drivr", kNames), "driver");
  EXPECT_EQ(nearest_name("colour", kNames), "");
}

TEST(NearestName, AForgottenUnitIsASlip) {
  constexpr std::array<std::string_view, 2> kNames = {"max_range_deg_per_s", "other"};
  EXPECT_EQ(nearest_name("max_range", kNames), "max_range_deg_per_s");
}

TEST(NearestName, OtherOrderLessWordsAndAnotherUnitAreSlips) {
  constexpr std::array<std::string_view, 5> kNames = {"range_min_m", "range_max_m", "disc_radius_m",
                                                      "yaw_deg", "z_m"};
  EXPECT_EQ(nearest_name("max_range_m", kNames), "range_max_m");
  EXPECT_EQ(nearest_name("radius_m", kNames), "disc_radius_m");
  EXPECT_EQ(nearest_name("yaw_rad", kNames), "yaw_deg");
  EXPECT_EQ(nearest_name("height_m", kNames), "");
}

TEST(Suggestion, NamesTheNearestOrAll) {
  constexpr std::array<std::string_view, 3> kNames = {"laser", "sonar", "bumper"};
  EXPECT_EQ(suggestion("lasser", kNames), "; did you mean `laser`?");
  EXPECT_EQ(suggestion("xylophone", kNames), "; there are laser, sonar and bumper");
}

}  // namespace
}  // namespace rave
