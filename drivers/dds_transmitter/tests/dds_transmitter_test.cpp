// SPDX-License-Identifier: Apache-2.0
// Over real participants of DDS on the loopback interface. Transmitters with the same parameters
// share one participant; those that differ have one each, as two processes do.
#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "dds_transmitter/air_options.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/live_testing/live_transmitter.hpp"
#include "rave/robot/radio_packet.hpp"

namespace rave::testing {
namespace {

using Given = LiveTransmitter::Given;
using std::string_literals::operator""s;

/// A network of this test alone.
std::string network(const std::string& name) { return name + std::to_string(::getpid()); }

std::string packet_from(const std::string& robot, std::uint32_t sequence,
                        const std::string& payload) {
  RadioPacket packet;
  packet.sender = radio_name_hash(robot);
  packet.channel = radio_name_hash("air");
  packet.sequence = sequence;
  packet.payload = std::as_bytes(std::span(payload.data(), payload.size()));
  std::string bytes(kRadioPacketOverhead + payload.size(), '\0');
  const std::span<char> room(bytes);
  EXPECT_EQ(encode(packet, std::as_writable_bytes(room)), bytes.size());
  return bytes;
}

std::optional<RadioPacket> read(const std::string& bytes) {
  return decode_radio_packet(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

std::string payload_of(const std::string& bytes) {
  const auto packet = read(bytes);
  if (!packet) return "no packet";
  return {reinterpret_cast<const char*>(packet->payload.data()), packet->payload.size()};
}

/// A hang guard of a minute.
template <class Condition>
bool wait_for(Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

bool hears(LiveTransmitter& transmitter, int others) {
  return wait_for([&] { return transmitter.report()["others"] == others; });
}

/// A participant of its own in the same air.
Given apart(const std::string& name, double queue_bytes) {
  return {{"network", network(name)}, {"queue_bytes", queue_bytes}};
}

TEST(DdsTransmitter, CarriesPacketsBetweenProcessesAndWithinOne) {
  LivePort ports[3];
  LiveTransmitter a("dds_transmitter");
  LiveTransmitter b("dds_transmitter");
  LiveTransmitter c("dds_transmitter");
  ASSERT_EQ(a.configure(apart("both", 100'000)), "");
  ASSERT_EQ(b.configure(apart("both", 100'000)), "");
  ASSERT_EQ(c.configure(apart("both", 200'000)), "");
  ASSERT_EQ(a.open(ports[0]), "");
  ASSERT_EQ(b.open(ports[1]), "");
  ASSERT_EQ(c.open(ports[2]), "");
  ASSERT_TRUE(hears(a, 1));
  ASSERT_TRUE(hears(c, 1));
  EXPECT_EQ(a.send(packet_from("anna", 1, "to both")), "");
  ASSERT_TRUE(ports[1].wait_packets(1));
  ASSERT_TRUE(ports[2].wait_packets(1));
  EXPECT_EQ(payload_of(ports[1].packets()[0]), "to both");
  EXPECT_EQ(payload_of(ports[2].packets()[0]), "to both");
  EXPECT_EQ(read(ports[2].packets()[0])->network, c.declaration().network);
  EXPECT_EQ(read(ports[2].packets()[0])->sender, radio_name_hash("anna"));
  EXPECT_EQ(c.send(packet_from("carl", 1, std::string(1400 - 56, 'c'))), "");
  for (LivePort* port : {&ports[0], &ports[1]}) ASSERT_TRUE(port->wait_packets(1));
  EXPECT_EQ(payload_of(ports[0].packets()[0]), std::string(1400 - 56, 'c'));
  // Its own words do not come back.
  EXPECT_EQ(ports[2].packets().size(), 1U);
  EXPECT_EQ(a.send(packet_from("anna", 2, std::string(1400 - 55, 'c'))),
            "1401 bytes that are no packet of at most 1400");
  EXPECT_EQ(a.send("hello"), "5 bytes that are no packet of at most 1400");
  // Closed and opened again, as a reset of the run does.
  a.close();
  EXPECT_EQ(c.send(packet_from("carl", 2, "to b")), "");
  ASSERT_TRUE(ports[1].wait_packets(3));
  ASSERT_EQ(a.open(ports[0]), "");
  EXPECT_EQ(c.send(packet_from("carl", 3, "again")), "");
  ASSERT_TRUE(ports[0].wait_packets(2));
  EXPECT_EQ(payload_of(ports[0].packets()[1]), "again");
}

TEST(DdsTransmitter, TenThousandPacketsArriveOnceAndInTheirOrder) {
  LivePort ports[2];
  LiveTransmitter a("dds_transmitter");
  LiveTransmitter b("dds_transmitter");
  ASSERT_EQ(a.configure(apart("many", 4'000'000)), "");
  ASSERT_EQ(b.configure(apart("many", 5'000'000)), "");
  ASSERT_EQ(a.open(ports[0]), "");
  ASSERT_EQ(b.open(ports[1]), "");
  ASSERT_TRUE(hears(a, 1));
  ASSERT_TRUE(hears(b, 1));
  constexpr std::uint32_t kCount = 10'000;
  for (std::uint32_t i = 1; i <= kCount; ++i) {
    ASSERT_EQ(a.send(packet_from("anna", i, std::to_string(i))), "");
  }
  ASSERT_TRUE(ports[1].wait_packets(kCount));
  const auto packets = ports[1].packets();
  ASSERT_EQ(packets.size(), kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(payload_of(packets[i]), std::to_string(i + 1));
  }
  EXPECT_EQ(a.report()["sent"], kCount);
}

TEST(DdsTransmitter, AnotherNetworkIsAnotherAir) {
  LivePort ports[2];
  LiveTransmitter a("dds_transmitter");
  LiveTransmitter near("dds_transmitter");
  LiveTransmitter far("dds_transmitter");
  ASSERT_EQ(a.configure(apart("here", 100'000)), "");
  ASSERT_EQ(near.configure(apart("here", 200'000)), "");
  ASSERT_EQ(far.configure(apart("there", 100'000)), "");
  LivePort port;
  ASSERT_EQ(a.open(port), "");
  ASSERT_EQ(near.open(ports[0]), "");
  ASSERT_EQ(far.open(ports[1]), "");
  ASSERT_TRUE(hears(a, 1));
  EXPECT_EQ(a.send(packet_from("anna", 1, "hello")), "");
  ASSERT_TRUE(ports[0].wait_packets(1));
  EXPECT_EQ(ports[1].packets().size(), 0U);
  EXPECT_EQ(far.report()["others"], 0);
}

TEST(DdsTransmitter, GarbageAndSamplesOfOtherRunsAreCountedAndDropped) {
  LivePort port;
  LiveTransmitter a("dds_transmitter");
  ASSERT_EQ(a.configure({{"network", network("loud")}}), "");
  ASSERT_EQ(a.open(port), "");
  // Somebody of another make in the same air.
  dds_transmitter::AirOptions options;
  options.run = dds_transmitter::run_of_network(network("loud"));
  options.interface = "127.0.0.1";
  auto bus = bus::Bus::open(dds_transmitter::bus_config(options));
  ASSERT_TRUE(bus) << bus.error().text();
  auto writer = bus::Writer<bus::Packet>::create(**bus);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(wait_for([&] { return writer->readers() == 1; }));
  bus::Packet sample{};
  ASSERT_TRUE(writer->write(sample)) << "a robot without a name";
  sample.from_robot = sample.communicator = 5;
  sample.x_m = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(writer->write(sample)) << "a place that is none";
  sample.x_m = 0;
  std::vector<std::uint8_t> huge(60'000);
  sample.payload = {
      ._maximum = 60'000, ._length = 60'000, ._buffer = huge.data(), ._release = false};
  ASSERT_TRUE(writer->write(sample)) << "more than fits";
  sample.payload = {};
  sample.run[0] ^= 1U;
  ASSERT_EQ(dds_write(writer->handle(), &sample), DDS_RETCODE_OK) << "of another run";
  sample.sequence_number = 9;
  ASSERT_TRUE(writer->write(sample));
  ASSERT_TRUE(port.wait_packets(1));
  EXPECT_EQ(read(port.packets()[0])->sequence, 9U);
  EXPECT_TRUE(wait_for([&] { return a.report()["refused"] == 3; })) << a.report();
  EXPECT_EQ(a.report()["foreign"], 1);
  EXPECT_EQ(port.packets().size(), 1U);
}

TEST(DdsTransmitter, SaysWhatIsWrongWithItsParameters) {
  const auto error_of = [](const Given& given) {
    LiveTransmitter transmitter("dds_transmitter");
    return transmitter.configure(given);
  };
  EXPECT_EQ(error_of({{"run", "12"s}}),
            "`run`: a run id has 32 hexadecimal digits, not 2 characters");
  EXPECT_TRUE(error_of({{"interface", "10.255.255.7"s}}).starts_with("peers: without multicast"));
  EXPECT_TRUE(error_of({{"security", "/nowhere"s}}).starts_with("security: there is no /nowhere"));
}

}  // namespace
}  // namespace rave::testing
