// SPDX-License-Identifier: Apache-2.0
#include "../src/radio_port.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <thread>

#include "rave/robot/radio_packet.hpp"

namespace rave::sim {
namespace {

TEST(RepeatFilter, TakesEachPacketOnceInAnyOrder) {
  RepeatFilter filter;
  for (const std::uint32_t sequence : {5U, 7U, 6U, 100U, 99U, 40U}) {
    EXPECT_TRUE(filter.accept(1, 2, 3, sequence)) << sequence;
    EXPECT_FALSE(filter.accept(1, 2, 3, sequence)) << sequence;
  }
  // Too old to know.
  EXPECT_FALSE(filter.accept(1, 2, 3, 36));
  // Others count on their own, and a sender that starts anew does too.
  EXPECT_TRUE(filter.accept(9, 2, 3, 5));
  EXPECT_TRUE(filter.accept(1, 9, 3, 5));
  EXPECT_TRUE(filter.accept(1, 2, 4, 1));
  EXPECT_FALSE(filter.accept(1, 2, 4, 1));
}

TEST(RepeatFilter, CountsOnBeyondTheLargestNumber) {
  RepeatFilter filter;
  EXPECT_TRUE(filter.accept(1, 2, 3, 0xFFFF'FFFFU));
  EXPECT_TRUE(filter.accept(1, 2, 3, 1));
  EXPECT_TRUE(filter.accept(1, 2, 3, 0));
  EXPECT_FALSE(filter.accept(1, 2, 3, 0xFFFF'FFFFU));
}

TEST(RadioPort, KeepsTheNewestPacketsAndCountsTheRest) {
  RadioPort port(8);
  for (int i = 0; i < 300; ++i) {
    const std::byte byte{static_cast<unsigned char>(i)};
    port.receive(&byte, 1);
  }
  const std::byte long_one[9] = {};
  port.receive(long_one, sizeof long_one);
  EXPECT_EQ(port.take_overruns().count, 300U - 256U + 1U);
  EXPECT_EQ(port.take_overruns().count, 0U);
  std::span<const std::byte> packet;
  for (int i = 44; i < 300; ++i) {
    ASSERT_TRUE(port.next(packet));
    ASSERT_EQ(packet.size(), 1U);
    EXPECT_EQ(packet[0], std::byte{static_cast<unsigned char>(i)});
  }
  EXPECT_FALSE(port.next(packet));
}

TEST(RadioPort, WhoFloodsPushesOutItsOwn) {
  RadioPort port(100);
  const auto say = [&port](const char* name, std::uint32_t sequence) {
    RadioPacket packet;
    packet.sender = radio_name_hash(name);
    packet.sequence = sequence;
    std::byte room[100];
    port.receive(room, encode(packet, room));
  };
  for (std::uint32_t i = 1; i <= 5000; ++i) {
    say("flooder", i);
    if (i % 100 == 0) {
      say("anna", i);
      say("bert", i);
    }
  }
  const RadioPort::Overruns overruns = port.take_overruns();
  EXPECT_EQ(overruns.count, 5100U - 256U);
  EXPECT_EQ(overruns.sender, radio_name_hash("flooder"));
  EXPECT_EQ(port.take_overruns().sender, 0U);
  std::map<std::uint32_t, std::vector<std::uint32_t>> heard;
  std::span<const std::byte> bytes;
  while (port.next(bytes)) {
    const auto packet = decode_radio_packet(bytes);
    heard[packet->sender].push_back(packet->sequence);
  }
  EXPECT_EQ(heard[radio_name_hash("anna")].size(), 50U);
  EXPECT_EQ(heard[radio_name_hash("bert")].size(), 50U);
  ASSERT_EQ(heard[radio_name_hash("flooder")].size(), 156U);
  EXPECT_EQ(heard[radio_name_hash("flooder")].back(), 5000U);
  for (const auto& [sender, order] : heard) EXPECT_TRUE(std::ranges::is_sorted(order)) << sender;
}

TEST(RadioPort, PassesOnWhatAnotherThreadPuts) {
  RadioPort port(4);
  std::thread driver([&] {
    for (int i = 0; i < 200; ++i) {
      const std::byte byte{static_cast<unsigned char>(i)};
      port.receive(&byte, 1);
    }
    port.fail("gone", 4);
  });
  int count = 0;
  std::span<const std::byte> packet;
  while (count < 200) {
    if (!port.next(packet)) continue;
    EXPECT_EQ(packet[0], std::byte{static_cast<unsigned char>(count++)});
  }
  driver.join();
  EXPECT_EQ(port.failure(), "gone");
  port.recover();
  EXPECT_EQ(port.failure(), "");
}

}  // namespace
}  // namespace rave::sim
