// SPDX-License-Identifier: Apache-2.0
#include "dds_transmitter/air_sample.hpp"

#include "rave/base/hash.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::dds_transmitter {

bus::Packet sample_of(const RadioPacket& packet, std::uint64_t number) noexcept {
  bus::Packet sample{};
  sample.number = number;
  sample.from_robot = packet.sender;
  sample.communicator = packet.channel;
  sample.sequence_number = packet.sequence;
  sample.to_kind = static_cast<rave_wire_RecipientKind>(packet.to);
  sample.to_robot = packet.to == RecipientKind::kEveryone ? rave_wire_kNone : packet.recipient;
  sample.sent_ns = packet.stamp_ns;
  sample.located = packet.position.has_value();
  const RadioPacket::Position position = packet.position.value_or(RadioPacket::Position{});
  sample.x_m = position.x_m;
  sample.y_m = position.y_m;
  sample.range_m = packet.range_m;
  sample.antenna_z_m = packet.antenna_z_m;
  sample.line_of_sight = packet.line_of_sight;
  // Safe cast: Cyclone DDS does not write to the samples that it sends.
  sample.payload._buffer =
      const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(packet.payload.data()));
  sample.payload._length = static_cast<std::uint32_t>(packet.payload.size());
  sample.payload._maximum = sample.payload._length;
  sample.payload._release = false;
  return sample;
}

Result<RadioPacket> packet_of(const bus::Packet& sample, std::uint32_t network,
                              std::size_t max_packet_bytes) {
  const bool everyone = sample.to_kind == rave_wire_TO_EVERYONE;
  // Names travel as hashes, and 0 stands for none.
  if (sample.from_robot == 0 || sample.communicator == 0 || (!everyone && sample.to_robot == 0)) {
    return fail(ErrorCode::kInvalidArgument, "a name of sender, recipient or communicator is 0");
  }
  const std::size_t size = kRadioPacketOverhead + sample.payload._length;
  if (size > max_packet_bytes) {
    return fail(ErrorCode::kInvalidArgument,
                "a packet of {} bytes with its header; expected at most {}", size,
                max_packet_bytes);
  }
  RadioPacket packet;
  packet.network = network;
  packet.sender = sample.from_robot;
  packet.channel = sample.communicator;
  packet.sequence = sample.sequence_number;
  // The writer stands for this start of the sending process.
  packet.boot = static_cast<std::uint32_t>(mix64(sample.writer));
  packet.to = static_cast<RecipientKind>(sample.to_kind);
  packet.recipient = everyone ? 0 : sample.to_robot;
  packet.stamp_ns = sample.sent_ns;
  if (sample.located) packet.position = {sample.x_m, sample.y_m};
  packet.range_m = sample.range_m;
  packet.antenna_z_m = sample.antenna_z_m;
  packet.line_of_sight = sample.line_of_sight;
  packet.payload = std::as_bytes(bus::elements(sample.payload));
  return packet;
}

}  // namespace rave::dds_transmitter
