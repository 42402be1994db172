// SPDX-License-Identifier: Apache-2.0
#include "../src/step_rate.hpp"

#include <gtest/gtest.h>

namespace rave::manager {
namespace {

constexpr std::int64_t kTenth_ns = 100'000'000;

TEST(StepRate, IsThatOfTheHostAndNotOfTheClock) {
  StepRate rate;
  EXPECT_FALSE(rate.at(0));
  // Of 100 steps a second it does six.
  for (std::int64_t i = 0; i <= 40; ++i) {
    rate.note(static_cast<std::uint64_t>(i * 6 / 10), i * kTenth_ns);
  }
  ASSERT_TRUE(rate.at(40 * kTenth_ns));
  EXPECT_NEAR(*rate.at(40 * kTenth_ns), 6, 1);
}

TEST(StepRate, FallsWhenAHostIsSilent) {
  StepRate rate;
  for (std::int64_t i = 0; i <= 10; ++i) {
    rate.note(static_cast<std::uint64_t>(10 * i), i * kTenth_ns);
  }
  EXPECT_DOUBLE_EQ(rate.at(11 * kTenth_ns).value(), 100);
  EXPECT_LT(rate.at(200 * kTenth_ns).value(), 20);
}

TEST(StepRate, BeginsAnewWithAnotherProcess) {
  StepRate rate;
  for (std::uint64_t i = 0; i <= 20; ++i)
    rate.note(1000 + 10 * i, static_cast<std::int64_t>(i) * kTenth_ns);
  rate.note(3, 21 * kTenth_ns);
  EXPECT_FALSE(rate.at(21 * kTenth_ns));
}

}  // namespace
}  // namespace rave::manager
