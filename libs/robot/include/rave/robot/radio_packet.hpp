// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rave/robot/message.hpp"

// What transmitters of the real world carry between hosts. docs/reference/radio-packet.md has the
// layout.
namespace rave {

/// One message on its way between hosts. Names travel as radio_name_hash(): hosts need not number
/// their robots alike.
struct RadioPacket {
  std::uint32_t network = 0;    ///< Packets of another one are not for us.
  std::uint32_t sender = 0;     ///< Hash of the robot's name.
  std::uint32_t recipient = 0;  ///< Hash of the robot's or the team's name; 0 for everyone.
  std::uint32_t channel = 0;    ///< Hash of the communicator's name.
  RecipientKind to = RecipientKind::kEveryone;
  std::uint32_t sequence = 0;  ///< Counts the messages of that communicator from 1.
  std::uint32_t boot = 0;      ///< Changes whenever the sender starts anew.
  std::int64_t stamp_ns = 0;   ///< Sent, by the sender's clock.
  /// Reported pose of the sender, world frame, in whole millimetres; nothing if it has none.
  struct Position {
    double x_m = 0;
    double y_m = 0;
    friend constexpr bool operator==(const Position&, const Position&) noexcept = default;
  };
  std::optional<Position> position;
  double range_m = 0;      ///< Of the sender, whole millimetres; 0: unlimited.
  double antenna_z_m = 0;  ///< Of the sender, whole millimetres, within +-32.767.
  bool line_of_sight = false;
  std::span<const std::byte> payload;  ///< At most 65535 bytes.
};

/// What the head and the checksum add to the payload.
inline constexpr std::size_t kRadioPacketOverhead = 56;

/// FNV-1a with 32 bits (Fowler, Noll, Vo; RFC 9923) of a name; never 0, which stands for nobody.
[[nodiscard]] std::uint32_t radio_name_hash(std::string_view name) noexcept;

/// CRC-32 of IEEE 802.3 (reflected, polynomial 0xEDB88320).
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes) noexcept;

/// Writes the packet into `room`; returns its size, or 0 if there is too little room.
[[nodiscard]] std::size_t encode(const RadioPacket& packet, std::span<std::byte> room) noexcept;

/// Reads one packet; `payload` points into `bytes`. Nothing if it is not exactly one whole packet
/// of version 1 with the right checksum.
[[nodiscard]] std::optional<RadioPacket> decode_radio_packet(
    std::span<const std::byte> bytes) noexcept;

}  // namespace rave
