// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::serial_transmitter {

/// CRC-16/CCITT-FALSE (polynomial 0x1021, begins with 0xFFFF, not reflected).
[[nodiscard]] std::uint16_t crc16(std::span<const std::byte> bytes) noexcept;

/// Appends one frame: a zero, the packet and its CRC-16 (high byte first) without any zero, by
/// COBS, and a zero. Source of COBS: S. Cheshire, M. Baker, "Consistent Overhead Byte Stuffing",
/// IEEE/ACM Transactions on Networking 7 (2), 1999.
void append_frame(std::span<const std::byte> packet, std::vector<std::byte>& out);

/// What append_frame() appends at most for a packet of this size.
[[nodiscard]] constexpr std::size_t max_frame_bytes(std::size_t packet_bytes) noexcept {
  return packet_bytes + 2 + (packet_bytes + 2) / 254 + 3;
}

/// Finds frames in a stream of bytes. Whatever came before, the next whole frame is found: a zero
/// stands nowhere else. Allocates nothing after construction.
class FrameDecoder {
 public:
  explicit FrameDecoder(std::size_t max_packet_bytes);

  /// Takes one byte; true if it ended a good frame, which packet() then shows.
  bool take(std::byte byte) noexcept;
  /// Valid until the next take().
  [[nodiscard]] std::span<const std::byte> packet() const noexcept {
    return std::span(buffer_).first(size_);
  }
  /// Forgets what has come of a frame, as after a break of the line.
  void restart() noexcept;
  /// Stretches between zeros that were no good frames.
  [[nodiscard]] std::uint64_t bad_frames() const noexcept { return bad_frames_; }

 private:
  bool end_frame() noexcept;

  std::vector<std::byte> buffer_;  ///< Encoded bytes, then decoded in place.
  std::size_t size_ = 0;
  bool in_frame_ = false;  ///< False: what comes belongs to the frame before.
  bool too_long_ = false;
  std::uint64_t bad_frames_ = 0;
};

}  // namespace rave::serial_transmitter
