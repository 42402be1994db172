// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/radio_packet.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace rave {
namespace {

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

RadioPacket example(std::string_view payload) {
  RadioPacket packet;
  packet.network = 1;
  packet.sender = radio_name_hash("anna");
  packet.recipient = radio_name_hash("bert");
  packet.channel = radio_name_hash("air");
  packet.to = RecipientKind::kRobot;
  packet.sequence = 0x89ABCDEF;
  packet.boot = 77;
  packet.stamp_ns = -5;
  packet.position = {-1.5, 2.25};
  packet.range_m = 12.5;
  packet.antenna_z_m = -0.25;
  packet.line_of_sight = true;
  packet.payload = bytes_of(payload);
  return packet;
}

std::vector<std::byte> encoded(const RadioPacket& packet) {
  std::vector<std::byte> room(2000);
  room.resize(encode(packet, room));
  return room;
}

TEST(RadioPacket, NamesAndChecksumsAreThePublishedOnes) {
  // Test vectors of the two algorithms.
  EXPECT_EQ(radio_name_hash(""), 0x811C9DC5U);
  EXPECT_EQ(radio_name_hash("a"), 0xE40C292CU);
  EXPECT_EQ(radio_name_hash("foobar"), 0xBF9CF968U);
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);
}

TEST(RadioPacket, ComesBackAsItWas) {
  for (const std::string& payload : {std::string(), std::string("hello"), std::string(1000, 'x')}) {
    const RadioPacket sent = example(payload);
    const auto bytes = encoded(sent);
    ASSERT_EQ(bytes.size(), payload.size() + kRadioPacketOverhead);
    const auto packet = decode_radio_packet(bytes);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->network, sent.network);
    EXPECT_EQ(packet->sender, sent.sender);
    EXPECT_EQ(packet->recipient, sent.recipient);
    EXPECT_EQ(packet->channel, sent.channel);
    EXPECT_EQ(packet->to, sent.to);
    EXPECT_EQ(packet->sequence, sent.sequence);
    EXPECT_EQ(packet->boot, sent.boot);
    EXPECT_EQ(packet->stamp_ns, sent.stamp_ns);
    ASSERT_TRUE(packet->position);
    EXPECT_DOUBLE_EQ(packet->position->x_m, -1.5);
    EXPECT_DOUBLE_EQ(packet->position->y_m, 2.25);
    EXPECT_DOUBLE_EQ(packet->range_m, 12.5);
    EXPECT_DOUBLE_EQ(packet->antenna_z_m, -0.25);
    EXPECT_TRUE(packet->line_of_sight);
    ASSERT_EQ(packet->payload.size(), payload.size());
    if (!payload.empty()) {
      EXPECT_EQ(std::memcmp(packet->payload.data(), payload.data(), payload.size()), 0);
    }
  }
}

TEST(RadioPacket, ARobotWithoutPoseSaysSo) {
  RadioPacket sent = example("x");
  sent.position.reset();
  sent.to = RecipientKind::kEveryone;
  const auto packet = decode_radio_packet(encoded(sent));
  ASSERT_TRUE(packet);
  EXPECT_FALSE(packet->position);
}

TEST(RadioPacket, EveryFlippedBitAndEveryWrongLengthIsNoticed) {
  const auto bytes = encoded(example("hello"));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto spoilt = bytes;
    spoilt[bit / 8] ^= std::byte{static_cast<unsigned char>(1U << (bit % 8))};
    EXPECT_FALSE(decode_radio_packet(spoilt)) << bit;
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(decode_radio_packet(std::span(bytes).first(size)));
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(decode_radio_packet(longer));
}

TEST(RadioPacket, TooLittleRoomIsNotWrittenTo) {
  std::array<std::byte, kRadioPacketOverhead + 4> room{};
  EXPECT_EQ(encode(example("hello"), room), 0U);
  EXPECT_EQ(encode(example("hell"), room), room.size());
}

TEST(RadioPacket, PlacesBeyondTheFormatAreCutOff) {
  RadioPacket sent = example("");
  sent.position = {1e12, -1e12};
  sent.range_m = 1e12;
  const auto packet = decode_radio_packet(encoded(sent));
  ASSERT_TRUE(packet);
  EXPECT_NEAR(packet->position->x_m, 2147483.647, 1e-6);
  EXPECT_NEAR(packet->position->y_m, -2147483.648, 1e-6);
  EXPECT_NEAR(packet->range_m, 4294967.295, 1e-6);
}

}  // namespace
}  // namespace rave
