// SPDX-License-Identifier: Apache-2.0
// Over real participants of DDS on the loopback interface. Transmitters with the same parameters
// share one participant; those that differ have one each, as two processes do.
#include <gtest/gtest.h>
#include <unistd.h>

#include "dds_transmitter/air_options.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/writer.hpp"
#include "rave/live_testing/await.hpp"
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
  if (!packet) return "not a packet";
  return {reinterpret_cast<const char*>(packet->payload.data()), packet->payload.size()};
}

/// A transmitter in an air of its test, and what it hears. One with another queue has a participant
/// of its own, as if it were in another process.
struct Station {
  explicit Station(const std::string& air, double queue_bytes = 100'000) {
    EXPECT_EQ(radio.configure({{"network", network(air)}, {"queue_bytes", queue_bytes}}), "");
    open();
  }
  void open() { EXPECT_EQ(radio.open(port), ""); }
  /// Whether it comes to know so many other participants.
  bool meets(int others) {
    return await([&] { return radio.report()["others"] == others; });
  }
  [[nodiscard]] std::string heard(std::size_t packet) const {
    return payload_of(port.packets()[packet]);
  }

  LivePort port;  // before what hands packets to it
  LiveTransmitter radio{"dds_transmitter"};
};

TEST(DdsTransmitter, WithoutAThreadIsAnErrorAndOpensLater) {
  LivePort port;
  LiveTransmitter radio("dds_transmitter");
  ASSERT_EQ(radio.configure({{"network", network("none")}}), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(radio.open(port).find("cannot start the thread of the network: "), 0U);
  }
  EXPECT_EQ(radio.open(port), "");
}

TEST(DdsTransmitter, CarriesPacketsBetweenProcessesAndWithinOne) {
  Station a("both");
  Station b("both");
  Station c("both", 200'000);
  ASSERT_TRUE(a.meets(1));
  ASSERT_TRUE(c.meets(1));
  EXPECT_EQ(a.radio.send(packet_from("anna", 1, "to both")), "");
  for (Station* station : {&b, &c}) {
    ASSERT_TRUE(station->port.wait_packets(1));
    EXPECT_EQ(station->heard(0), "to both");
  }
  EXPECT_EQ(read(c.port.packets()[0])->network, c.radio.declaration().network);
  EXPECT_EQ(read(c.port.packets()[0])->sender, radio_name_hash("anna"));
  EXPECT_EQ(c.radio.send(packet_from("carl", 1, std::string(1400 - 56, 'c'))), "");
  for (Station* station : {&a, &b}) ASSERT_TRUE(station->port.wait_packets(1));
  EXPECT_EQ(a.heard(0), std::string(1400 - 56, 'c'));
  // Its own words do not come back.
  EXPECT_EQ(c.port.packets().size(), 1U);
  EXPECT_EQ(a.radio.send(packet_from("anna", 2, std::string(1400 - 55, 'c'))),
            "1401 bytes are not a packet of at most 1400");
  EXPECT_EQ(a.radio.send("hello"), "5 bytes are not a packet of at most 1400");
  // Closed and opened again, as a reset of the run does.
  a.radio.close();
  EXPECT_EQ(c.radio.send(packet_from("carl", 2, "to b")), "");
  ASSERT_TRUE(b.port.wait_packets(3));
  a.open();
  EXPECT_EQ(c.radio.send(packet_from("carl", 3, "again")), "");
  ASSERT_TRUE(a.port.wait_packets(2));
  EXPECT_EQ(a.heard(1), "again");
}

TEST(DdsTransmitter, TenThousandPacketsArriveOnceAndInTheirOrder) {
  Station a("many", 4'000'000);
  Station b("many", 5'000'000);
  ASSERT_TRUE(a.meets(1));
  ASSERT_TRUE(b.meets(1));
  constexpr std::uint32_t kCount = 10'000;
  for (std::uint32_t i = 1; i <= kCount; ++i) {
    ASSERT_EQ(a.radio.send(packet_from("anna", i, std::to_string(i))), "");
  }
  ASSERT_TRUE(b.port.wait_packets(kCount));
  const auto packets = b.port.packets();
  ASSERT_EQ(packets.size(), kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    ASSERT_EQ(payload_of(packets[i]), std::to_string(i + 1));
  }
  EXPECT_EQ(a.radio.report()["sent"], kCount);
}

TEST(DdsTransmitter, AnotherNetworkIsAnotherAir) {
  Station a("here");
  Station near("here", 200'000);
  Station far("there");
  ASSERT_TRUE(a.meets(1));
  EXPECT_EQ(a.radio.send(packet_from("anna", 1, "hello")), "");
  ASSERT_TRUE(near.port.wait_packets(1));
  EXPECT_EQ(far.port.packets().size(), 0U);
  EXPECT_EQ(far.radio.report()["others"], 0);
}

TEST(DdsTransmitter, GarbageAndSamplesOfOtherRunsAreCountedAndDropped) {
  Station a("loud", 1'048'576);
  // Somebody of another make in the same air.
  dds_transmitter::AirOptions options;
  options.run = dds_transmitter::run_of_network(network("loud"));
  options.interface = "127.0.0.1";
  auto bus = bus::Bus::open(dds_transmitter::bus_config(options));
  ASSERT_TRUE(bus) << bus.error().text();
  auto writer = bus::Writer<bus::Packet>::create(**bus);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(await([&] { return writer->readers() == 1; }));
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
  ASSERT_TRUE(a.port.wait_packets(1));
  EXPECT_EQ(read(a.port.packets()[0])->sequence, 9U);
  EXPECT_TRUE(await([&] { return a.radio.report()["refused"] == 3; })) << a.radio.report();
  EXPECT_EQ(a.radio.report()["foreign"], 1);
  EXPECT_EQ(a.port.packets().size(), 1U);
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
