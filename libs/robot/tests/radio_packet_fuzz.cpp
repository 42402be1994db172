// SPDX-License-Identifier: Apache-2.0
// Whatever is decoded is encoded to the same bytes. Once as it came and once with the checksum that
// it should have, so that the fuzzer gets beyond it.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "rave/base/check.hpp"
#include "rave/robot/radio_packet.hpp"

namespace {

void check(std::span<const std::byte> bytes) {
  const auto packet = rave::decode_radio_packet(bytes);
  if (!packet) return;
  RAVE_CHECK(packet->payload.size() + rave::kRadioPacketOverhead == bytes.size());
  std::vector<std::byte> again(bytes.size());
  RAVE_CHECK(rave::encode(*packet, again) == bytes.size());
  const auto same = rave::decode_radio_packet(again);
  RAVE_CHECK(same && same->sequence == packet->sequence && same->position == packet->position &&
             same->range_m == packet->range_m && same->antenna_z_m == packet->antenna_z_m &&
             same->to == packet->to && same->stamp_ns == packet->stamp_ns &&
             std::ranges::equal(same->payload, packet->payload));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  std::transform(data, data + size, bytes.begin(), [](std::uint8_t b) { return std::byte{b}; });
  check(bytes);
  if (size < 4) return 0;
  const std::uint32_t crc = rave::crc32(std::span(bytes).first(size - 4));
  for (unsigned i = 0; i < 4; ++i) {
    bytes[size - 4 + i] = static_cast<std::byte>(crc >> (8 * i) & 0xFFU);
  }
  check(bytes);
  return 0;
}
