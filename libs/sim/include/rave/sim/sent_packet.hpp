// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/robot/message.hpp"

namespace rave::sim {

/// A message that left its robot completely in a step, with the data of the sender that a receiver
/// needs to decide whether it receives it; the same data as in a real radio packet
/// (docs/reference/radio-packet.md).
struct SentPacket {
  RobotId robot;                   ///< The sender.
  std::uint32_t communicator = 0;  ///< Index among the sender's communicators.
  std::uint32_t sequence = 0;      ///< Number of the message at its communicator, from 1.
  Recipient to;
  std::int64_t stamp_ns = 0;     ///< When the program sent it, simulation time.
  std::int64_t complete_ns = 0;  ///< Time at which the last byte left.
  double x_m = 0;                ///< Reported position of the sender in W, if `located`.
  double y_m = 0;
  double range_m = 0;  ///< Range of the sender's radio; 0: no limit.
  double antenna_z_m = 0;
  std::uint8_t located = 0;        ///< 1: the sender has a reported pose.
  std::uint8_t line_of_sight = 0;  ///< 1: the sender's radio requires it.
  std::uint32_t first_byte = 0;    ///< Index of its first byte in SentPackets::bytes.
  std::uint32_t size = 0;          ///< Bytes, at most kMostBytes.

  static constexpr std::uint32_t kMostBytes = 0xFFFF;
};

/// The messages that left their robots in one step, ordered by (robot, communicator, sequence).
struct SentPackets {
  std::vector<SentPacket> packets;
  std::vector<std::byte> bytes;  ///< The bytes of all messages, concatenated.

  /// Removes all messages; keeps the allocated memory.
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
  /// The bytes of a message; `packet` must be one of `packets`.
  [[nodiscard]] std::span<const std::byte> bytes_of(const SentPacket& packet) const noexcept {
    return std::span(bytes).subspan(packet.first_byte, packet.size);
  }
};

}  // namespace rave::sim
