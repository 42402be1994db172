// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::serial_transmitter {

/// CRC-16/CCITT-FALSE (polynomial 0x1021, initial value 0xFFFF, not reflected).
[[nodiscard]] std::uint16_t crc16(std::span<const std::byte> bytes) noexcept;

/// Appends one frame: a zero; the packet and its CRC-16 (high byte first), encoded by COBS so that
/// they contain no zero; and a zero. Source of COBS: S. Cheshire, M. Baker, "Consistent Overhead
/// Byte Stuffing", IEEE/ACM Transactions on Networking 7 (2), 1999.
void append_frame(std::span<const std::byte> packet, std::vector<std::byte>& out);

/// The largest number of bytes that append_frame() adds for a packet of this size.
[[nodiscard]] constexpr std::size_t max_frame_bytes(std::size_t packet_bytes) noexcept {
  return packet_bytes + 2 + (packet_bytes + 2) / 254 + 3;
}

/// Finds frames in a byte stream. It finds the next complete frame after any garbage, because zeros
/// occur between frames only. No allocation after construction.
class FrameDecoder {
 public:
  explicit FrameDecoder(std::size_t max_packet_bytes);

  /// Adds one byte; returns true if it completes a valid frame, see packet().
  bool take(std::byte byte) noexcept;
  /// Valid until the next take().
  [[nodiscard]] std::span<const std::byte> packet() const noexcept {
    return std::span(buffer_).first(size_);
  }
  /// Discards a partial frame, for example after a break of the line.
  void restart() noexcept;
  /// Number of invalid frames.
  [[nodiscard]] std::uint64_t bad_frames() const noexcept { return bad_frames_; }

 private:
  bool end_frame() noexcept;

  std::vector<std::byte> buffer_;  ///< Encoded bytes, later decoded in place.
  std::size_t size_ = 0;
  bool in_frame_ = false;  ///< False: the next byte begins a frame.
  bool too_long_ = false;
  std::uint64_t bad_frames_ = 0;
};

}  // namespace rave::serial_transmitter
