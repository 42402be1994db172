// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/robot/radio_packet.hpp"

namespace rave::dds_transmitter {

/// A packet of a radio as a sample of `rave/radio`, which shows the packet's payload. Robots and
/// communicator are the hashes of their names, since hosts of this topic need not number them
/// alike; the network is that of the run, and the sender's start that of the writer.
[[nodiscard]] bus::Packet sample_of(const RadioPacket& packet, std::uint64_t number) noexcept;

/// And back, for those of `network`; its payload is the sample's. Error kInvalidArgument: names
/// that no robot can have, or more bytes than `max_packet_bytes` with the head. The sample has
/// passed bus::validate().
[[nodiscard]] Result<RadioPacket> packet_of(const bus::Packet& sample, std::uint32_t network,
                                            std::size_t max_packet_bytes);

}  // namespace rave::dds_transmitter
