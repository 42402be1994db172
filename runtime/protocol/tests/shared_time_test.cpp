// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/shared_time.hpp"

#include <gtest/gtest.h>

namespace rave::real_time {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// The clock of the manager is `ahead_ns` ahead of ours; 1 ms there, `back_ns` back.
bus::ClockExchange exchange(std::int64_t asked_ns, std::int64_t ahead_ns,
                            std::int64_t back_ns = 1'000'000) {
  const std::int64_t received_ns = asked_ns + 1'000'000 + ahead_ns;
  return {asked_ns, received_ns, received_ns + 50'000, asked_ns + 1'000'000 + 50'000 + back_ns};
}

TEST(SharedTime, IsThatOfTheManagerOnceTheRunHasBegun) {
  SharedTime time;
  EXPECT_FALSE(time.known());
  ASSERT_TRUE(time.hear(1, exchange(0, 7 * kSecond_ns), false, 0));
  EXPECT_FALSE(time.known());
  // Zero at 20 s of their clock, which is 13 s of ours.
  ASSERT_TRUE(time.hear(1, exchange(kSecond_ns, 7 * kSecond_ns), true, 20 * kSecond_ns));
  ASSERT_TRUE(time.known());
  EXPECT_EQ(time.zero_ns(), 13 * kSecond_ns);
  EXPECT_EQ(time.at(15 * kSecond_ns).ns, 2 * kSecond_ns);
  const auto reading = time.reading(2 * kSecond_ns);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->offset.ns, 7 * kSecond_ns);
  EXPECT_GE(reading->bound.ns, 1'000'000);
}

TEST(SharedTime, ABetterReadingMovesItAWorseOneDoesNot) {
  SharedTime time;
  // 9 ms on the way back: 4 ms off, and within the bound.
  ASSERT_TRUE(time.hear(1, exchange(0, 0, 9'000'000), true, kSecond_ns));
  EXPECT_EQ(time.zero_ns(), kSecond_ns + 4'000'000);
  ASSERT_TRUE(time.hear(1, exchange(kSecond_ns, 0), true, kSecond_ns));
  EXPECT_EQ(time.zero_ns(), kSecond_ns);
  ASSERT_TRUE(time.hear(1, exchange(2 * kSecond_ns, 0, 9'000'000), true, kSecond_ns));
  EXPECT_EQ(time.zero_ns(), kSecond_ns);
}

TEST(SharedTime, StaysWhileThereIsNoManagerAndFollowsTheNextOne) {
  SharedTime time;
  ASSERT_TRUE(time.hear(1, exchange(0, 0), true, 0));
  EXPECT_EQ(time.at(100 * kSecond_ns).ns, 100 * kSecond_ns);
  EXPECT_FALSE(time.reading(100 * kSecond_ns)) << "nothing is known that is so old";
  // Another clock; it has not begun before it knows the time of the run from somebody.
  const bus::ClockExchange first = exchange(100 * kSecond_ns, -50 * kSecond_ns);
  ASSERT_TRUE(time.hear(2, first, false, 0));
  EXPECT_EQ(time.at(100 * kSecond_ns).ns, 100 * kSecond_ns);
  const bus::ClockExchange second = exchange(101 * kSecond_ns, -50 * kSecond_ns);
  ASSERT_TRUE(time.hear(2, second, true, -49'999'000'000));
  EXPECT_EQ(time.at(101 * kSecond_ns).ns, 100'999'000'000);
}

TEST(SharedTime, RefusesAnExchangeThatCannotBe) {
  SharedTime time;
  const Status heard = time.hear(1, {10, 5, 6, 9}, true, 0);
  ASSERT_FALSE(heard);
  EXPECT_NE(heard.error().message.find("impossible"), std::string::npos) << heard.error().message;
  EXPECT_FALSE(time.known());
}

TEST(SharedTime, WithoutAManagerItIsOnesOwn) {
  SharedTime time;
  time.begin_alone(5 * kSecond_ns);
  EXPECT_EQ(time.at(7 * kSecond_ns).ns, 2 * kSecond_ns);
}

}  // namespace
}  // namespace rave::real_time
