// SPDX-License-Identifier: Apache-2.0
#include "serial_transmitter/serial_frame.hpp"

namespace rave::serial_transmitter {

std::uint16_t crc16(std::span<const std::byte> bytes) noexcept {
  std::uint32_t crc = 0xFFFF;
  for (const std::byte byte : bytes) {
    // Bit by bit: at the rate of a serial line a table would save nothing that counts.
    crc ^= std::to_integer<std::uint32_t>(byte) << 8U;
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x1021U : crc << 1U;
    crc &= 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

void append_frame(std::span<const std::byte> packet, std::vector<std::byte>& out) {
  const std::uint16_t crc = crc16(packet);
  out.push_back(std::byte{0});
  std::size_t code_at = out.size();
  std::uint8_t code = 1;  // number of following bytes of the block, plus one
  out.push_back(std::byte{0});
  // COBS: each block begins with the distance to the next zero, so the data contain none and a zero
  // always ends a frame.
  const auto put = [&](std::byte byte) {
    if (byte != std::byte{0}) {
      out.push_back(byte);
      // A block of 254 bytes without a zero ends here; its code 255 means that no zero follows it.
      if (++code < 0xFF) return;
    }
    out[code_at] = std::byte{code};
    code_at = out.size();
    code = 1;
    out.push_back(std::byte{0});
  };
  for (const std::byte byte : packet) put(byte);
  put(static_cast<std::byte>(crc >> 8U));
  put(static_cast<std::byte>(crc & 0xFFU));
  out[code_at] = std::byte{code};
  out.push_back(std::byte{0});
}

FrameDecoder::FrameDecoder(std::size_t max_packet_bytes)
    : buffer_(max_frame_bytes(max_packet_bytes)) {}

void FrameDecoder::restart() noexcept {
  size_ = 0;
  in_frame_ = too_long_ = false;
}

bool FrameDecoder::take(std::byte byte) noexcept {
  if (!in_frame_) {
    in_frame_ = true;
    too_long_ = false;
    size_ = 0;
  }
  if (byte == std::byte{0}) return end_frame();
  // The rest of a frame that is too long is read and dropped; the next zero begins anew.
  if (size_ == buffer_.size()) {
    too_long_ = true;
  } else {
    buffer_[size_++] = byte;
  }
  return false;
}

bool FrameDecoder::end_frame() noexcept {
  in_frame_ = false;
  if (size_ == 0) return false;  // between two frames
  std::size_t to = 0;
  std::size_t at = 0;
  bool good = !too_long_;
  while (good && at < size_) {
    const auto code = std::to_integer<std::size_t>(buffer_[at]);
    const std::size_t end = at + code;
    if (end > size_) {
      good = false;
      break;
    }
    for (++at; at < end; ++at) buffer_[to++] = buffer_[at];
    if (code < 0xFF && at < size_) buffer_[to++] = std::byte{0};
  }
  if (good && to >= 2) {
    const std::span<const std::byte> packet = std::span(buffer_).first(to - 2);
    const auto high = std::to_integer<std::uint16_t>(buffer_[to - 2]);
    const auto low = std::to_integer<std::uint16_t>(buffer_[to - 1]);
    if (crc16(packet) == ((high << 8U) | low)) {
      size_ = to - 2;
      return true;
    }
  }
  ++bad_frames_;
  size_ = 0;
  return false;
}

}  // namespace rave::serial_transmitter
