// SPDX-License-Identifier: Apache-2.0
#include "rave/line/backoff.hpp"

#include <gtest/gtest.h>

namespace rave::line {
namespace {

TEST(Backoff, DoublesUpToItsLimitAndStartsOver) {
  Backoff backoff;
  Backoff::Wait last{0};
  for (int i = 0; i < 20; ++i) {
    const auto wait = backoff.next();
    EXPECT_GE(wait, last);
    EXPECT_LE(wait, Backoff::kLongest);
    last = wait;
  }
  EXPECT_EQ(last, Backoff::kLongest);
  backoff.reset();
  EXPECT_EQ(backoff.next(), Backoff::kFirst);
  EXPECT_EQ(backoff.next(), 2 * Backoff::kFirst);
}

}  // namespace
}  // namespace rave::line
