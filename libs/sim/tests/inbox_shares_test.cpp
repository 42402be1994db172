// SPDX-License-Identifier: Apache-2.0
#include "../src/inbox_shares.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace rave::sim {
namespace {

/// An inbox of 8 messages and 40 bytes.
struct Inbox {
  std::array<MessageHead, 8> heads{};
  std::array<std::byte, 40> data{};
  Mailbox box{heads.data(), data.data(), 8, 40, 0, 0, 0, 0};
  InboxShares shares;

  bool put(std::uint32_t from, std::uint32_t sequence, const std::string& text) {
    MessageHead head;
    head.from = from;
    head.sequence = sequence;
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    shares.make_room(box, from, bytes.size());
    const bool fits = box.put(head, bytes);
    if (fits) shares.add(from);
    return fits;
  }
  /// All that is in it: sender, colon, text.
  [[nodiscard]] std::string content() const {
    std::string all;
    for (std::uint32_t i = 0; i < box.count; ++i) {
      const auto bytes = box.bytes_of(heads[i]);
      all += std::to_string(heads[i].from) + ":" +
             std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()) + " ";
    }
    return all;
  }
};

TEST(InboxShares, WhoHasMostMakesRoomForWhoHasLess) {
  Inbox inbox;
  for (std::uint32_t i = 1; i <= 8; ++i) EXPECT_TRUE(inbox.put(1, i, "f" + std::to_string(i)));
  EXPECT_FALSE(inbox.put(1, 9, "f9")) << "nobody has more than the sender itself";
  EXPECT_TRUE(inbox.put(2, 1, "a"));
  EXPECT_TRUE(inbox.put(3, 1, "bb"));
  EXPECT_TRUE(inbox.put(2, 2, "aaa"));
  EXPECT_EQ(inbox.content(), "1:f1 1:f2 1:f3 1:f4 1:f5 2:a 3:bb 2:aaa ");
  EXPECT_EQ(inbox.box.bytes, 16U);
  EXPECT_EQ(inbox.box.dropped, 4U);
  EXPECT_TRUE(inbox.put(2, 3, "c"));
  EXPECT_TRUE(inbox.put(3, 2, "d"));
  EXPECT_FALSE(inbox.put(2, 4, "e")) << "three each: nobody has two more";
  EXPECT_EQ(inbox.content(), "1:f1 1:f2 1:f3 2:a 3:bb 2:aaa 2:c 3:d ");
}

TEST(InboxShares, MakesRoomForLongMessagesToo) {
  Inbox inbox;
  for (std::uint32_t i = 1; i <= 4; ++i) EXPECT_TRUE(inbox.put(1, i, "0123456789"));
  EXPECT_TRUE(inbox.put(2, 1, "abcdefghijklmno"));
  EXPECT_EQ(inbox.content(), "1:0123456789 1:0123456789 2:abcdefghijklmno ");
  EXPECT_FALSE(inbox.put(3, 1, std::string(41, 'x'))) << "longer than the inbox";
}

TEST(InboxShares, AnEmptiedInboxBelongsToAll) {
  Inbox inbox;
  for (std::uint32_t i = 1; i <= 8; ++i) EXPECT_TRUE(inbox.put(1, i, "f"));
  inbox.box.clear();
  inbox.shares.clear();
  for (std::uint32_t i = 1; i <= 8; ++i) EXPECT_TRUE(inbox.put(2, i, "a"));
  EXPECT_EQ(inbox.box.dropped, 0U);
}

}  // namespace
}  // namespace rave::sim
