// SPDX-License-Identifier: Apache-2.0
#include "dds_transmitter/air_sample.hpp"

#include <gtest/gtest.h>

#include <array>

#include "dds_transmitter/air_options.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

namespace rave::dds_transmitter {
namespace {

RadioPacket example(std::span<const std::byte> payload) {
  RadioPacket packet;
  packet.network = 7;
  packet.sender = radio_name_hash("anna");
  packet.to = RecipientKind::kRobot;
  packet.recipient = radio_name_hash("bert");
  packet.channel = radio_name_hash("flock");
  packet.sequence = 12;
  packet.boot = 5;
  packet.stamp_ns = 1'500;
  packet.position = {1.25, -2.5};
  packet.range_m = 3;
  packet.antenna_z_m = -0.125;
  packet.line_of_sight = true;
  packet.payload = payload;
  return packet;
}

TEST(AirSample, ComesBackWithAllThatAReceiverMustKnow) {
  const std::array<std::byte, 3> bytes = {std::byte{1}, std::byte{0}, std::byte{255}};
  bus::Packet sample = sample_of(example(bytes), 9);
  sample.writer = 77;
  bus::testing::Decoded<bus::Packet> decoded;
  ASSERT_TRUE(decoded.decode(bus::testing::encode(sample)));
  ASSERT_TRUE(bus::validate(decoded.sample()));
  EXPECT_EQ(decoded.sample().number, 9U);
  const auto packet = packet_of(decoded.sample(), 8, 100);
  ASSERT_TRUE(packet) << packet.error().text();
  EXPECT_EQ(packet->network, 8U) << "that of the receiver: the run is the network";
  EXPECT_EQ(packet->sender, radio_name_hash("anna"));
  EXPECT_EQ(packet->to, RecipientKind::kRobot);
  EXPECT_EQ(packet->recipient, radio_name_hash("bert"));
  EXPECT_EQ(packet->channel, radio_name_hash("flock"));
  EXPECT_EQ(packet->sequence, 12U);
  EXPECT_EQ(packet->stamp_ns, 1'500);
  EXPECT_EQ(packet->position, (RadioPacket::Position{1.25, -2.5}));
  EXPECT_EQ(packet->range_m, 3);
  EXPECT_EQ(packet->antenna_z_m, -0.125);
  EXPECT_TRUE(packet->line_of_sight);
  EXPECT_TRUE(std::ranges::equal(packet->payload, bytes));
  // A process that starts again is another writer, so its numbers count anew.
  bus::Packet other = decoded.sample();
  other.writer = 78;
  EXPECT_NE(packet_of(other, 8, 100)->boot, packet->boot);
}

TEST(AirSample, RefusesWhatIsNoPacket) {
  const std::array<std::byte, 50> bytes{};
  bus::Packet sample = sample_of(example(bytes), 1);
  EXPECT_EQ(packet_of(sample, 7, 105).error().message,
            "a packet of 106 bytes with its header; expected at most 105");
  EXPECT_TRUE(packet_of(sample, 7, 106));
  for (auto* const name : {&sample.from_robot, &sample.communicator, &sample.to_robot}) {
    const std::uint32_t before = std::exchange(*name, 0);
    EXPECT_EQ(packet_of(sample, 7, 200).error().message,
              "a name of sender, recipient or communicator is 0");
    *name = before;
  }
}

TEST(AirOptions, ANetworkIsARunThatAllKnowByItsName) {
  EXPECT_EQ(run_of_network("rave"), run_of_network("rave"));
  EXPECT_NE(run_of_network("rave"), run_of_network("lab"));
}

}  // namespace
}  // namespace rave::dds_transmitter
