// SPDX-License-Identifier: Apache-2.0
#include "rave/base/hash.hpp"

#include <gtest/gtest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <vector>

namespace rave {
namespace {

ItemHash pose_item(std::uint64_t step, std::uint32_t robot, double x) {
  ItemHash item(step, robot, HashChannel::kPose, 0);
  item.add(x);
  return item;
}

TEST(RunHash, DoesNotDependOnTheOrderOfItems) {
  RunHash forward;
  RunHash backward;
  for (std::uint32_t i = 0; i < 100; ++i) forward.add(pose_item(7, i, 0.5 * i));
  for (std::uint32_t i = 100; i-- > 0;) backward.add(pose_item(7, i, 0.5 * i));
  EXPECT_EQ(forward, backward);
}

/// Whichever instructions a length is hashed by.
TEST(ContentHash, IsXxh3OfAnyLength) {
  std::vector<std::byte> bytes(3000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 37 + i / 7);
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    const std::size_t begin = bytes.size() - length;  // at any alignment
    ASSERT_EQ(content_hash(std::span(bytes).subspan(begin)),
              XXH3_64bits(bytes.data() + begin, length))
        << length;
  }
}

TEST(RunHash, PartialSumsOfProcessesAddUp) {
  RunHash whole;
  RunHash first;
  RunHash second;
  for (std::uint32_t i = 0; i < 10; ++i) {
    whole.add(pose_item(1, i, i));
    (i < 3 ? first : second).add(pose_item(1, i, i));
  }
  first.merge(second);
  EXPECT_EQ(whole, first);
}

TEST(RunHash, NoticesEveryPartOfAnItem) {
  const auto base = pose_item(3, 4, 1.0).value();
  EXPECT_NE(base, pose_item(2, 4, 1.0).value());
  EXPECT_NE(base, pose_item(3, 5, 1.0).value());
  EXPECT_NE(base, pose_item(3, 4, 1.0000000000000002).value());
  ItemHash other_channel(3, 4, HashChannel::kEvent, 0);
  other_channel.add(1.0);
  EXPECT_NE(base, other_channel.value());
  ItemHash other_device(3, 4, HashChannel::kPose, 1);
  other_device.add(1.0);
  EXPECT_NE(base, other_device.value());
}

TEST(ContentHash, IsXxh3) {
  EXPECT_EQ(content_hash({}), 0x2d06800538d394c2ULL);  // the published value of nothing, seed 0
}

TEST(ItemHash, EveryFlippedBitOfAPayloadChangesIt) {
  // Sizes that the function treats differently.
  for (const std::size_t size : {1U, 3U, 8U, 16U, 21U, 56U, 64U, 130U, 240U, 720U, 2000U}) {
    std::vector<std::byte> payload(size);
    ItemHash clean(1, 2, HashChannel::kPercept, 3);
    clean.add_bytes(payload);
    for (std::size_t bit = 0; bit < size * 8; ++bit) {
      auto flipped = payload;
      flipped[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
      ItemHash item(1, 2, HashChannel::kPercept, 3);
      item.add_bytes(flipped);
      EXPECT_NE(item.value(), clean.value()) << size << " bytes, bit " << bit;
    }
  }
}

TEST(ItemHash, TheLengthOfAPayloadCounts) {
  std::array<std::byte, 8> payload{};
  ItemHash shorter(1, 2, HashChannel::kPercept, 3);
  shorter.add_bytes(std::span(payload).first(5));
  ItemHash longer(1, 2, HashChannel::kPercept, 3);
  longer.add_bytes(payload);
  EXPECT_NE(shorter.value(), longer.value());
}

}  // namespace
}  // namespace rave
