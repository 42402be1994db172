// SPDX-License-Identifier: Apache-2.0
// Over real sockets of the loopback interface.
#include <gtest/gtest.h>

#include "rave/base_testing/no_threads.hpp"
#include "rave/live_testing/live_transmitter.hpp"

namespace rave::testing {
namespace {

using Given = LiveTransmitter::Given;
using std::string_literals::operator""s;

std::string peer_of(LiveTransmitter& other) {
  return "127.0.0.1:" + std::to_string(other.report()["port"].get<int>());
}

TEST(UdpTransmitter, CarriesPacketsBetweenPeersBothWays) {
  LivePort port_a;
  LivePort port_b;
  LivePort port_c;
  LiveTransmitter a("udp_transmitter");
  LiveTransmitter b("udp_transmitter");
  LiveTransmitter c("udp_transmitter");
  // To the port of `discard`, where nobody listens.
  ASSERT_EQ(a.configure({{"peers", "127.0.0.1:9"s}}), "");
  ASSERT_EQ(b.configure({{"peers", peer_of(a)}}), "");
  ASSERT_EQ(c.configure({{"peers", peer_of(a) + ", " + peer_of(b)}}), "");
  ASSERT_EQ(a.open(port_a), "");
  ASSERT_EQ(b.open(port_b), "");
  ASSERT_EQ(c.open(port_c), "");
  EXPECT_EQ(b.send("from b"), "");
  ASSERT_TRUE(port_a.wait_packets(1));
  EXPECT_EQ(c.send(std::string(1400, 'c')), "");
  EXPECT_EQ(c.send(""), "");
  ASSERT_TRUE(port_a.wait_packets(3));
  ASSERT_TRUE(port_b.wait_packets(2));
  EXPECT_EQ(port_a.packets()[0], "from b");
  EXPECT_EQ(port_b.packets()[0], std::string(1400, 'c'));
  EXPECT_EQ(port_b.packets()[1], "");
  // Nobody listens there: that is no loss of the device.
  EXPECT_EQ(a.send("into the void"), "");
  EXPECT_EQ(a.send("into the void"), "");
  EXPECT_EQ(port_a.failure(), "");
  EXPECT_EQ(c.report()["sent"], 2);
  // Closed and opened again, as a reset of the run does.
  a.close();
  ASSERT_EQ(a.open(port_a), "");
  EXPECT_EQ(b.send("again"), "");
  ASSERT_TRUE(port_a.wait_packets(4));
}

TEST(UdpTransmitter, WithoutAThreadIsAnErrorAndOpensLater) {
  LivePort port;
  LiveTransmitter radio("udp_transmitter");
  ASSERT_EQ(radio.configure({{"peers", "127.0.0.1:9"s}}), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(radio.open(port).find("cannot start the thread of the socket: "), 0U);
  }
  EXPECT_EQ(radio.open(port), "");
}

/// Containers may have a loopback without multicast: the one thing that this test cannot make.
bool lacks_multicast(const std::string& error) {
  return error.find("Network is unreachable") != std::string::npos ||
         error.find("No such device") != std::string::npos;
}

TEST(UdpTransmitter, AGroupReachesAllOfItsMembers) {
  LivePort ports[3];
  LiveTransmitter a("udp_transmitter");
  LiveTransmitter b("udp_transmitter");
  LiveTransmitter c("udp_transmitter");
  LiveTransmitter* all[] = {&a, &b, &c};
  LiveTransmitter free("udp_transmitter");
  ASSERT_EQ(free.configure({{"peers", "127.0.0.1:9"s}}), "");
  const std::string group = "239.255.7.1:" + std::to_string(free.report()["port"].get<int>());
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string error = all[i]->configure({{"group", group}});
    if (lacks_multicast(error)) GTEST_SKIP() << "no multicast here: " << error;
    ASSERT_EQ(error, "");
    ASSERT_EQ(all[i]->open(ports[i]), "");
  }
  const std::string error = b.send("hello");
  if (lacks_multicast(error)) GTEST_SKIP() << "no multicast here: " << error;
  ASSERT_EQ(error, "");
  for (LivePort& port : ports) {
    ASSERT_TRUE(port.wait_packets(1));
    EXPECT_EQ(port.packets()[0], "hello");
  }
}

TEST(UdpTransmitter, AnAddressThatCannotBeReachedIsReported) {
  LivePort port;
  LiveTransmitter a("udp_transmitter");
  // From the loopback interface nothing gets to a documentation address (RFC 5737).
  ASSERT_EQ(a.configure({{"peers", "192.0.2.1:4711"s}}), "");
  ASSERT_EQ(a.open(port), "");
  const std::string error = a.send("x");
  EXPECT_TRUE(error.starts_with("cannot send to 192.0.2.1:4711: ")) << error;
  ASSERT_TRUE(port.wait_failures(1));
  EXPECT_EQ(port.failure(), error);
  EXPECT_EQ(a.report()["not_sent"], 1);
}

TEST(UdpTransmitter, SaysWhatIsWrongWithItsParameters) {
  const auto error_of = [](const Given& given) {
    LiveTransmitter transmitter("udp_transmitter");
    return transmitter.configure(given);
  };
  EXPECT_EQ(error_of({}),
            "expected `peers`, `group` or `port`: without them it can neither send nor receive");
  EXPECT_EQ(error_of({{"peers", "127.0.0.1:4711 nobody"s}}),
            "`peers`: expected an address such as 127.0.0.1:4711, found `nobody`");
  EXPECT_EQ(error_of({{"peers", "localhost:4711"s}}),
            "`peers`: expected a numeric address such as 127.0.0.1:4711, found `localhost:4711`");
  EXPECT_EQ(error_of({{"peers", "127.0.0.1:4711"s}, {"listen", "nowhere"s}}),
            "`listen` must be a numeric address such as 127.0.0.1, not `nowhere`");
  EXPECT_EQ(error_of({{"group", "239.255.7.1:4711"s}, {"port", 5.0}}),
            "`group` already has a port: give either `port` or `group`");
}

}  // namespace
}  // namespace rave::testing
