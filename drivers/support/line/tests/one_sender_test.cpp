// SPDX-License-Identifier: Apache-2.0
#include "rave/line/one_sender.hpp"

#include <gtest/gtest.h>

namespace rave::line {
namespace {

constexpr double kPatience_s = 1;

TEST(OneSender, TheFirstCountsAndARivalIsToldOnce) {
  OneSender<char> one;
  EXPECT_TRUE(one.take('a', 0, kPatience_s).counts);
  int told = 0;
  for (int i = 1; i < 100; ++i) {
    const auto rival = one.take('b', i - 0.5, kPatience_s);
    EXPECT_FALSE(rival.counts) << i;
    told += rival.new_rival ? 1 : 0;
    const auto same = one.take('a', i, kPatience_s);
    EXPECT_TRUE(same.counts && !same.changed);
  }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(one.present(), 'a');
}

TEST(OneSender, AnotherTakesThePlaceOfOneThatIsSilentOrGivesWay) {
  OneSender<char> one;
  EXPECT_FALSE(one.take('a', 0, kPatience_s).changed);
  EXPECT_FALSE(one.take('b', 0.99, kPatience_s).counts);
  const auto later = one.take('b', 1, kPatience_s);
  EXPECT_TRUE(later.counts && later.changed && !later.new_rival);
  EXPECT_FALSE(one.take('a', 1.1, kPatience_s).counts) << "it is the rival now";
  EXPECT_TRUE(one.take('c', 1.1, kPatience_s, true).changed);
  EXPECT_EQ(one.present(), 'c');
}

TEST(OneSender, OneThatComesAgainIsNoNewOneForEachMessage) {
  OneSender<int> one;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(one.take(i, 0.01 * i, kPatience_s, one.heard_once()).counts) << i;
  }
  EXPECT_TRUE(one.take(98, 1, kPatience_s, one.heard_once()).counts);
  EXPECT_FALSE(one.heard_once());
  EXPECT_FALSE(one.take(99, 1, kPatience_s, one.heard_once()).counts);
}

}  // namespace
}  // namespace rave::line
