// SPDX-License-Identifier: Apache-2.0
#include "rave/base/word_table.hpp"

#include <gtest/gtest.h>

#include "rave/base/names.hpp"

namespace rave {
namespace {

enum class Light { kRed, kGreen, kBroken };
constexpr WordTable<Light, 2> kLights = {{{"red", Light::kRed}, {"green", Light::kGreen}}};

TEST(WordTable, AreFoundBothWays) {
  EXPECT_EQ(kLights.of(Light::kGreen), "green");
  EXPECT_EQ(kLights.of(Light::kBroken), "");
  EXPECT_EQ(kLights.find("red"), Light::kRed);
  EXPECT_EQ(kLights.find("Red"), std::nullopt);
}

TEST(WordTable, CountsItsRows) {
  constexpr auto kTable = word_table<Light>(
      {{"red", Light::kRed}, {"green", Light::kGreen}, {"broken", Light::kBroken}});
  static_assert(kTable.words().size() == 3);
  EXPECT_EQ(kTable.find("broken"), Light::kBroken);
}

TEST(WordTable, AreListedInMessages) {
  EXPECT_EQ(join_names(kLights.words()), "red and green");
  EXPECT_EQ(join_names(kLights.words(), "or"), "red or green");
}

}  // namespace
}  // namespace rave
