// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as samples of `rave/radio`, as a transmitter takes them: deserialiser,
// validation, reading, and the packet that a host is handed. The first byte is the byte order.
#include "dds_transmitter/air_sample.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include "rave/base/check.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave;
  if (size == 0) return 0;
  constexpr std::size_t kLimit = 300;
  constexpr std::uint32_t kNetwork = 7;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  bus::testing::Decoded<bus::Packet> decoded;
  if (!decoded.decode(bytes, (data[0] & 0x80U) != 0) || !bus::validate(decoded.sample())) return 0;
  const auto packet = dds_transmitter::packet_of(decoded.sample(), kNetwork, kLimit);
  if (!packet) return 0;
  // Whatever passes is a packet that every host can read.
  std::array<std::byte, kLimit> room{};
  const std::size_t length = encode(*packet, room);
  RAVE_CHECK(length > 0);
  const auto again = decode_radio_packet(std::span(room).first(length));
  RAVE_CHECK(again && again->sender == packet->sender && again->network == kNetwork);
  RAVE_CHECK(again->payload.size() == packet->payload.size());
  return 0;
}
