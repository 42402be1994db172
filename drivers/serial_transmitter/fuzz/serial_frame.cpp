// SPDX-License-Identifier: Apache-2.0
// Any stream: no frame is longer than the limit, and a good frame behind it is always found.
#include "serial_transmitter/serial_frame.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rave/base/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::serial_transmitter;
  constexpr std::size_t kLimit = 300;
  FrameDecoder decoder(kLimit);
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < size; ++i) {
    bytes.push_back(std::byte{data[i]});
    if (!decoder.take(std::byte{data[i]})) continue;
    RAVE_CHECK(decoder.packet().size() <= max_frame_bytes(kLimit));
  }
  // What came, cut to the limit, as a packet of its own.
  bytes.resize(std::min(bytes.size(), kLimit));
  std::vector<std::byte> frame;
  append_frame(bytes, frame);
  RAVE_CHECK(frame.size() <= max_frame_bytes(bytes.size()));
  RAVE_CHECK(std::count(frame.begin(), frame.end(), std::byte{0}) == 2);
  bool found = false;
  for (const std::byte byte : frame) {
    if (decoder.take(byte)) found = std::ranges::equal(decoder.packet(), bytes) || found;
  }
  RAVE_CHECK(found);
  return 0;
}
