// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rave/robot/message.hpp"

// The packet that transmitters of the real world carry between hosts.
// docs/reference/radio-packet.md has the layout.
namespace rave {

/// One message between hosts. Names are sent as radio_name_hash(), because hosts may number their
/// robots differently.
struct RadioPacket {
  std::uint32_t network = 0;    ///< Packets with another number are ignored.
  std::uint32_t sender = 0;     ///< Hash of the robot's name.
  std::uint32_t recipient = 0;  ///< Hash of the robot's or the team's name; 0 for everyone.
  std::uint32_t channel = 0;    ///< Hash of the communicator's name.
  RecipientKind to = RecipientKind::kEveryone;
  std::uint32_t sequence = 0;  ///< Number of the message at its communicator, from 1.
  std::uint32_t boot = 0;      ///< Differs after each restart of the sender.
  std::int64_t stamp_ns = 0;   ///< Time of sending, by the sender's clock.
  /// Reported pose of the sender, world frame, in whole millimetres; empty if it has none.
  struct Position {
    double x_m = 0;
    double y_m = 0;
    friend constexpr bool operator==(const Position&, const Position&) noexcept = default;
  };
  std::optional<Position> position;
  double range_m = 0;      ///< Range of the sender, whole millimetres; 0: unlimited.
  double antenna_z_m = 0;  ///< Antenna height of the sender, whole millimetres, within +-32.767.
  bool line_of_sight = false;
  std::span<const std::byte> payload;  ///< At most 65535 bytes.
};

/// Bytes of header and checksum.
inline constexpr std::size_t kRadioPacketOverhead = 56;

/// 32-bit FNV-1a hash of a name (Fowler, Noll, Vo; RFC 9923); never 0, which means no name.
[[nodiscard]] std::uint32_t radio_name_hash(std::string_view name) noexcept;

/// CRC-32 of IEEE 802.3 (reflected, polynomial 0xEDB88320).
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes) noexcept;

/// Writes the packet into `room`; returns its size, or 0 if `room` is too small.
[[nodiscard]] std::size_t encode(const RadioPacket& packet, std::span<std::byte> room) noexcept;

/// Decodes one packet; `payload` points into `bytes`. Empty if `bytes` is not exactly one complete
/// packet of version 1 with the right checksum.
[[nodiscard]] std::optional<RadioPacket> decode_radio_packet(
    std::span<const std::byte> bytes) noexcept;

}  // namespace rave
