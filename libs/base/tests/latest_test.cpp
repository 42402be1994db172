// SPDX-License-Identifier: Apache-2.0
#include "rave/base/latest.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

namespace rave {
namespace {

TEST(Latest, NothingIsTakenBeforeItIsPublished) {
  Latest<int> latest;
  EXPECT_FALSE(latest.take());
  EXPECT_EQ(latest.value(), 0);
  latest.draft() = 7;
  EXPECT_FALSE(latest.take());
  EXPECT_EQ(latest.value(), 0);
}

TEST(Latest, TheNewestIsTakenOnce) {
  Latest<int> latest;
  for (const int value : {1, 2, 3}) {
    latest.draft() = value;
    latest.publish();
  }
  EXPECT_TRUE(latest.take());
  EXPECT_EQ(latest.value(), 3);
  EXPECT_FALSE(latest.take());
  EXPECT_EQ(latest.value(), 3);
  latest.draft() = 4;
  latest.publish();
  EXPECT_EQ(latest.value(), 3);
  EXPECT_TRUE(latest.take());
  EXPECT_EQ(latest.value(), 4);
}

TEST(Latest, AReaderNeverSeesHalfOfAValueNorAnOlderOne) {
  constexpr std::uint64_t kLast = 200'000;
  Latest<std::array<std::uint64_t, 16>> latest;
  std::thread writer([&latest] {
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      latest.draft().fill(i);
      latest.publish();
    }
  });
  std::uint64_t newest = 0;
  while (newest < kLast) {
    if (!latest.take()) {
      std::this_thread::yield();
      continue;
    }
    const auto& value = latest.value();
    ASSERT_GT(value.front(), newest);
    newest = value.front();
    for (const std::uint64_t part : value) ASSERT_EQ(part, newest);
  }
  writer.join();
}

}  // namespace
}  // namespace rave
