// SPDX-License-Identifier: Apache-2.0
#include "serial_transmitter/serial_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace rave::serial_transmitter {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}

std::vector<std::byte> frame_of(std::string_view packet) {
  std::vector<std::byte> frame;
  append_frame(bytes_of(packet), frame);
  return frame;
}

std::vector<std::string> found(FrameDecoder& decoder, const std::vector<std::byte>& stream) {
  std::vector<std::string> packets;
  for (const std::byte byte : stream) {
    if (!decoder.take(byte)) continue;
    std::string& packet = packets.emplace_back();
    for (const std::byte b : decoder.packet()) packet.push_back(static_cast<char>(b));
  }
  return packets;
}

void append(std::vector<std::byte>& stream, const std::vector<std::byte>& more) {
  stream.insert(stream.end(), more.begin(), more.end());
}

TEST(SerialFrame, ChecksumIsThePublishedOne) { EXPECT_EQ(crc16(bytes_of("123456789")), 0x29B1); }

TEST(SerialFrame, PacketsOfAllLengthsComeBack) {
  FrameDecoder decoder(1000);
  for (std::size_t size = 0; size <= 1000; ++size) {
    for (const bool zeros : {false, true}) {
      std::string packet(size, zeros ? '\0' : 'x');
      if (size > 3) packet[size / 2] = zeros ? 'y' : '\0';
      const auto frame = frame_of(packet);
      EXPECT_LE(frame.size(), max_frame_bytes(size));
      EXPECT_EQ(std::count(frame.begin(), frame.end(), std::byte{0}), 2);
      ASSERT_EQ(found(decoder, frame), std::vector<std::string>{packet}) << size;
    }
  }
  EXPECT_EQ(decoder.bad_frames(), 0U);
}

TEST(SerialFrame, NoFlippedBitPasses) {
  const auto frame = frame_of("hello, world");
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    auto spoilt = frame;
    spoilt[bit / 8] ^= std::byte{static_cast<unsigned char>(1U << (bit % 8))};
    FrameDecoder decoder(100);
    for (const std::string& packet : found(decoder, spoilt)) {
      // Only the zeros around it may be hit without harm.
      EXPECT_EQ(packet, "hello, world") << bit;
    }
  }
}

TEST(SerialFrame, TheFirstWholeFrameAfterGarbageIsFound) {
  FrameDecoder decoder(100);
  std::vector<std::byte> stream = bytes_of(std::string(500, '\x81'));
  append(stream, frame_of("one"));
  const auto torn = frame_of("torn");
  stream.insert(stream.end(), torn.begin(), torn.begin() + 5);
  append(stream, frame_of("two"));
  append(stream, bytes_of("noise"));
  append(stream, frame_of("three"));
  EXPECT_EQ(found(decoder, stream), (std::vector<std::string>{"one", "two", "three"}));
  EXPECT_EQ(decoder.bad_frames(), 3U);
}

TEST(SerialFrame, ALongerOneThanAllowedIsPassedOver) {
  FrameDecoder decoder(50);
  std::vector<std::byte> stream = frame_of(std::string(80, 'x'));
  append(stream, frame_of("short"));
  EXPECT_EQ(found(decoder, stream), std::vector<std::string>{"short"});
}

}  // namespace
}  // namespace rave::serial_transmitter
