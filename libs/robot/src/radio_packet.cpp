// SPDX-License-Identifier: Apache-2.0
// Messages of robots as bytes for radios, in a fixed layout (docs/reference/radio-packet.md): the
// receiver may be another program on another processor.
#include "rave/robot/radio_packet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "rave/robot/radio_sender.hpp"

namespace rave {
namespace {

constexpr std::byte kMagic[] = {std::byte{'R'}, std::byte{'V'}};
constexpr std::byte kVersion{1};
constexpr std::size_t kHeadBytes = kRadioPacketOverhead - 4;
constexpr unsigned kKindMask = 0x3;
constexpr unsigned kHasPosition = 0x4;
constexpr unsigned kLineOfSight = 0x8;

// CRC-32 of IEEE 802.3, as in zlib and Ethernet: reversed polynomial 0xEDB88320. Not the function
// of libs/record, which is zlib's: programs link this library, and must not need zlib.
constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
    table[i] = c;
  }
  return table;
}

/// Little-endian on any machine.
template <class T>
void put(std::byte* at, T value) noexcept {
  auto bits = static_cast<std::make_unsigned_t<T>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    at[i] = static_cast<std::byte>(bits & 0xFFU);
    bits = static_cast<decltype(bits)>(static_cast<std::uint64_t>(bits) >> 8U);
  }
}

template <class T>
T get(const std::byte* at) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) bits = (bits << 8U) | std::to_integer<unsigned>(at[i]);
  return static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits));
}

/// Whole millimetres, clamped to the range of T.
/// Millimetres in 32 bits reach 2000 km and need half the room of doubles.
template <class T>
T millimetres(double length_m) noexcept {
  const double mm = std::round(length_m * 1000);
  if (!(mm > static_cast<double>(std::numeric_limits<T>::min()))) {
    return std::numeric_limits<T>::min();
  }
  if (mm >= static_cast<double>(std::numeric_limits<T>::max())) {
    return std::numeric_limits<T>::max();
  }
  return static_cast<T>(mm);
}

}  // namespace

// FNV-1a, 32 bits. 0 means that there is no name, so no name has it.
std::uint32_t radio_name_hash(std::string_view name) noexcept {
  std::uint32_t hash = 0x811C9DC5U;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193U;
  return hash == 0 ? 1 : hash;
}

std::uint32_t crc32(std::span<const std::byte> bytes) noexcept {
  static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
  std::uint32_t c = 0xFFFFFFFFU;
  for (const std::byte b : bytes) {
    c = kTable[(c ^ std::to_integer<std::uint32_t>(b)) & 0xFFU] ^ (c >> 8U);
  }
  return ~c;
}

std::size_t encode(const RadioPacket& packet, std::span<std::byte> room) noexcept {
  const std::size_t size = kRadioPacketOverhead + packet.payload.size();
  if (packet.payload.size() > 0xFFFFU || size > room.size()) return 0;
  std::byte* const at = room.data();
  unsigned flags = static_cast<unsigned>(packet.to) & kKindMask;
  if (packet.position) flags |= kHasPosition;
  if (packet.line_of_sight) flags |= kLineOfSight;
  const RadioPacket::Position position = packet.position.value_or(RadioPacket::Position{});
  // Offsets as in docs/reference/radio-packet.md; the checksum is last and covers all before it.
  std::memcpy(at, kMagic, sizeof kMagic);
  at[2] = kVersion;
  at[3] = static_cast<std::byte>(flags);
  put(at + 4, packet.network);
  put(at + 8, packet.sender);
  put(at + 12, packet.recipient);
  put(at + 16, packet.channel);
  put(at + 20, packet.sequence);
  put(at + 24, packet.boot);
  put(at + 28, packet.stamp_ns);
  put(at + 36, millimetres<std::int32_t>(position.x_m));
  put(at + 40, millimetres<std::int32_t>(position.y_m));
  put(at + 44, millimetres<std::uint32_t>(packet.range_m));
  put(at + 48, millimetres<std::int16_t>(packet.antenna_z_m));
  put(at + 50, static_cast<std::uint16_t>(packet.payload.size()));
  if (!packet.payload.empty()) {
    std::memcpy(at + kHeadBytes, packet.payload.data(), packet.payload.size());
  }
  put(at + size - 4, crc32({at, size - 4}));
  return size;
}

std::uint32_t radio_sender(std::span<const std::byte> packet) noexcept {
  return packet.size() < kRadioPacketOverhead ? 0 : get<std::uint32_t>(packet.data() + 8);
}

std::optional<RadioPacket> decode_radio_packet(std::span<const std::byte> bytes) noexcept {
  const std::byte* const at = bytes.data();
  if (bytes.size() < kRadioPacketOverhead || !std::equal(kMagic, kMagic + 2, at) ||
      at[2] != kVersion || bytes.size() != kRadioPacketOverhead + get<std::uint16_t>(at + 50) ||
      get<std::uint32_t>(at + bytes.size() - 4) != crc32(bytes.first(bytes.size() - 4))) {
    return std::nullopt;
  }
  const auto flags = std::to_integer<unsigned>(at[3]);
  // Bits that this version does not know are refused: a later one may change what the packet means.
  if (flags > (kKindMask | kHasPosition | kLineOfSight) || (flags & kKindMask) > 2) {
    return std::nullopt;
  }
  RadioPacket packet;
  packet.to = static_cast<RecipientKind>(flags & kKindMask);
  packet.line_of_sight = (flags & kLineOfSight) != 0;
  packet.network = get<std::uint32_t>(at + 4);
  packet.sender = get<std::uint32_t>(at + 8);
  packet.recipient = get<std::uint32_t>(at + 12);
  packet.channel = get<std::uint32_t>(at + 16);
  packet.sequence = get<std::uint32_t>(at + 20);
  packet.boot = get<std::uint32_t>(at + 24);
  packet.stamp_ns = get<std::int64_t>(at + 28);
  if ((flags & kHasPosition) != 0) {
    packet.position =
        RadioPacket::Position{get<std::int32_t>(at + 36) * 1e-3, get<std::int32_t>(at + 40) * 1e-3};
  }
  packet.range_m = get<std::uint32_t>(at + 44) * 1e-3;
  packet.antenna_z_m = get<std::int16_t>(at + 48) * 1e-3;
  packet.payload = bytes.subspan(kHeadBytes, bytes.size() - kRadioPacketOverhead);
  return packet;
}

}  // namespace rave
