// SPDX-License-Identifier: Apache-2.0
#include "rave/line/datagram_socket.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rave::line {
namespace {

constexpr Wait kHangGuard{100'000};

std::string error_of(const std::string& peer) {
  const auto parsed = parse_peer(peer);
  return parsed ? "" : parsed.error().message;
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(DatagramSocket, PeersAreNumericAddressesWithAPort) {
  const auto peers = parse_peers(" 127.0.0.1:4711, [::1]:9\t10.0.0.2:1 ");
  ASSERT_TRUE(peers) << peers.error().text();
  ASSERT_EQ(peers->size(), 3U);
  EXPECT_EQ((*peers)[0].text, "127.0.0.1:4711");
  EXPECT_EQ((*peers)[1].address.ss_family, AF_INET6);
  EXPECT_EQ((*peers)[2].text, "10.0.0.2:1");
  EXPECT_TRUE(parse_peers(" ,")->empty());
  EXPECT_EQ(error_of("127.0.0.1"), "expected an address such as 127.0.0.1:4711, found `127.0.0.1`");
  EXPECT_EQ(error_of("robot:4711"),
            "expected a numeric address such as 127.0.0.1:4711, found `robot:4711`");
}

TEST(DatagramSocket, CarriesDatagramsAndCutsThemOffAtTheRoomThereIs) {
  Wake wake;
  ASSERT_TRUE(wake.open());
  auto from = DatagramSocket::open("127.0.0.1", 0, nullptr);
  auto to = DatagramSocket::open("127.0.0.1", 0, nullptr);
  ASSERT_TRUE(from && to);
  ASSERT_NE(to->port(), 0);
  const auto peer = parse_peer("127.0.0.1:" + std::to_string(to->port()));
  ASSERT_TRUE(peer);
  ASSERT_TRUE(from->send(bytes_of("hello"), *peer));
  ASSERT_TRUE(from->send(bytes_of(""), *peer));
  std::array<std::byte, 4> room{};
  Peer sender;
  ReadResult got = to->receive(room, kHangGuard, wake, &sender);
  EXPECT_EQ(sender.text, "127.0.0.1:" + std::to_string(from->port()));
  EXPECT_EQ(got.end, ReadEnd::kBytes);
  EXPECT_EQ(got.size, 4U);
  EXPECT_EQ(room[3], std::byte{'l'});
  got = to->receive(room, kHangGuard, wake);
  EXPECT_EQ(got.end, ReadEnd::kBytes);
  EXPECT_EQ(got.size, 0U) << "an empty one is one too";
  EXPECT_EQ(to->receive(room, Wait(0), wake).end, ReadEnd::kTimeout);
  wake.ring();
  EXPECT_EQ(to->receive(room, kHangGuard, wake).end, ReadEnd::kWoken);
}

TEST(DatagramSocket, SaysWhyItCannotListen) {
  const auto error_at = [](const std::string& host, std::uint16_t port) {
    const auto opened = DatagramSocket::open(host, port, nullptr);
    return opened ? std::string() : opened.error().message;
  };
  EXPECT_EQ(error_at("robot", 0),
            "`listen` must be a numeric address such as 127.0.0.1, not `robot`");
  const auto taken = DatagramSocket::open("127.0.0.1", 0, nullptr);
  ASSERT_TRUE(taken);
  const std::string port = std::to_string(taken->port());
  EXPECT_EQ(error_at("127.0.0.1", taken->port()),
            "cannot listen on UDP port " + port + " of 127.0.0.1: Address already in use");
}

}  // namespace
}  // namespace rave::line
