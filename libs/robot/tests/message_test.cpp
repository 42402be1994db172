// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>

#include "rave/robot/program.hpp"

namespace rave {
namespace {

struct Greeting {
  std::int32_t number = 0;
  float value = 0;
};

/// Both directions of a communicator of 3 messages and 20 bytes.
class MessageTest : public ::testing::Test {
 protected:
  MessageTest() {
    item_.communicators = &view_;
    item_.now_ns = 5;
  }
  std::array<MessageHead, 3> in_heads_{};
  std::array<MessageHead, 3> out_heads_{};
  std::array<std::byte, 20> in_bytes_{};
  std::array<std::byte, 20> out_bytes_{};
  Mailbox in_{in_heads_.data(), in_bytes_.data(), 3, 20, 0, 0, 0, 0};
  Mailbox out_{out_heads_.data(), out_bytes_.data(), 3, 20, 0, 0, 0, 0};
  CommunicatorView view_{&in_, &out_};
  CommunicatorInfo info_{"air", 3, 20, 12, 0};
  CommunicatorHandle radio_{0, &info_};
  DecideItem item_;
};

TEST_F(MessageTest, AStructComesOutAsItWentIn) {
  Commands commands(item_);
  EXPECT_TRUE(commands.send(radio_, Greeting{7, 0.5F}, Recipient::one(4)));
  ASSERT_EQ(out_.count, 1U);
  EXPECT_EQ(out_.heads[0].to, Recipient::one(4));
  EXPECT_EQ(out_.heads[0].stamp_ns, 5);
  MessageHead head = out_.heads[0];
  head.from = 9;
  ASSERT_TRUE(in_.put(head, out_.bytes_of(out_.heads[0])));
  const Percepts percepts(item_);
  ASSERT_EQ(percepts.messages(radio_).size(), 1U);
  for (const Message message : percepts.messages(radio_)) {
    EXPECT_EQ(message.from, 9U);
    const auto greeting = message.as<Greeting>();
    ASSERT_TRUE(greeting);
    EXPECT_EQ(greeting->number, 7);
    EXPECT_EQ(greeting->value, 0.5F);
    EXPECT_FALSE(message.as<float>());
  }
}

TEST_F(MessageTest, TooLongOrTooManyIsRefused) {
  Commands commands(item_);
  const std::array<std::byte, 13> long_one{};
  EXPECT_FALSE(commands.send(radio_, std::span<const std::byte>(long_one)));
  EXPECT_TRUE(commands.send(radio_, std::span<const std::byte>(long_one).first(12)));
  EXPECT_FALSE(commands.send(radio_, std::span<const std::byte>(long_one).first(9)));
  EXPECT_TRUE(commands.send(radio_, std::span<const std::byte>(long_one).first(8)));
  EXPECT_TRUE(commands.send(radio_, std::span<const std::byte>()));
  EXPECT_FALSE(commands.send(radio_, std::span<const std::byte>()));
  EXPECT_EQ(out_.count, 3U);
  EXPECT_EQ(out_.bytes, 20U);
  EXPECT_EQ(out_.dropped, 2U);
}

TEST(Kinds, HaveNames) {
  for (int i = 0; i <= static_cast<int>(ReadingKind::kValues); ++i) {
    EXPECT_NE(to_string(static_cast<ReadingKind>(i)), "unknown") << i;
  }
  for (int i = 0; i <= static_cast<int>(OrderKind::kPlace); ++i) {
    EXPECT_NE(to_string(static_cast<OrderKind>(i)), "unknown") << i;
  }
  for (int i = 0; i <= static_cast<int>(CommandKind::kValues); ++i) {
    EXPECT_NE(to_string(static_cast<CommandKind>(i)), "unknown") << i;
  }
}

}  // namespace
}  // namespace rave
