// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/robot/message.hpp"

namespace rave::sim {

/// One message that left its robot completely in a step, and what a receiver must know of the
/// sender at that moment to find out by itself whether it hears it: the same that a packet on a
/// real radio carries (docs/reference/radio-packet.md).
struct SentPacket {
  RobotId robot;                   ///< Who sent it.
  std::uint32_t communicator = 0;  ///< Index among the sender's communicators.
  std::uint32_t sequence = 0;      ///< Counts the messages of that communicator from 1.
  Recipient to;
  std::int64_t stamp_ns = 0;     ///< When the program sent it, simulation time.
  std::int64_t complete_ns = 0;  ///< When the last byte had left.
  double x_m = 0;                ///< Reported position of the sender in W, if `located`.
  double y_m = 0;
  double range_m = 0;  ///< Of the sender's radio; 0: no limit.
  double antenna_z_m = 0;
  std::uint8_t located = 0;        ///< 1: the sender has a reported pose.
  std::uint8_t line_of_sight = 0;  ///< 1: the sender's radio asks for it.
  std::uint32_t first_byte = 0;    ///< Of the message, in SentPackets::bytes.
  std::uint32_t size = 0;          ///< Bytes, at most kMostBytes.

  static constexpr std::uint32_t kMostBytes = 0xFFFF;
};

/// The messages that left their robots in one step, by (robot, communicator, sequence).
struct SentPackets {
  std::vector<SentPacket> packets;
  std::vector<std::byte> bytes;  ///< Of all messages, one after the other.

  /// Drops all and keeps the memory.
  void clear() noexcept {
    packets.clear();
    bytes.clear();
  }
  void add(SentPacket packet, std::span<const std::byte> message) {
    packet.first_byte = static_cast<std::uint32_t>(bytes.size());
    packet.size = static_cast<std::uint32_t>(message.size());
    packets.push_back(packet);
    bytes.insert(bytes.end(), message.begin(), message.end());
  }
  /// `packet` is one of `packets`, whose bytes are there.
  [[nodiscard]] std::span<const std::byte> bytes_of(const SentPacket& packet) const noexcept {
    return std::span(bytes).subspan(packet.first_byte, packet.size);
  }
};

}  // namespace rave::sim
