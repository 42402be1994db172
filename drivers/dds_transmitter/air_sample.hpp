// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/robot/radio_packet.hpp"

namespace rave::dds_transmitter {

/// Converts a radio packet to a sample of `rave/radio`, which refers to the packet's payload.
/// Robots and communicator are sent as hashes of their names, because hosts may number them
/// differently. The network is identified by the run, and the sender's start by the writer id.
[[nodiscard]] bus::Packet sample_of(const RadioPacket& packet, std::uint64_t number) noexcept;

/// The inverse, for `network`; the payload refers to the sample. Error kInvalidArgument: invalid
/// names, or more than `max_packet_bytes` with header. The sample must have passed bus::validate().
[[nodiscard]] Result<RadioPacket> packet_of(const bus::Packet& sample, std::uint32_t network,
                                            std::size_t max_packet_bytes);

}  // namespace rave::dds_transmitter
