// SPDX-License-Identifier: Apache-2.0
// The decoder of the Open Interface's stream with any bytes: what it gives out must be a frame of
// the packets that were asked for.
#include <cstdint>
#include <numeric>
#include <vector>

#include "create_oi/oi_code.hpp"
#include "create_oi/oi_decoder.hpp"
#include "create_oi/oi_state.hpp"
#include "rave/base/check.hpp"

namespace {

using namespace rave::oi;

std::vector<std::uint8_t> packets_for(std::uint8_t choice) {
  switch (choice % 4) {
    case 0:
      return {7, 9, 10, 11, 12, 35, 43, 44};
    case 1:
      return {7, 9, 10, 11, 12, 35, 21, 22, 23, 24, 25, 26};
    case 2:
      return {29, 13};
    default:
      return {100};
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // Any bytes are a body, too.
  OiState any;
  (void)read_packets({data, size}, any);
  StreamDecoder decoder(packets_for(data[0]));
  std::size_t whole = 0;
  for (std::size_t i = 1; i < size; ++i) {
    const Frame* const frame = decoder.push(data[i], static_cast<double>(i));
    if (frame == nullptr) continue;
    ++whole;
    const std::size_t total = decoder.frame_size();
    RAVE_CHECK(frame->body.size() == total - 3);
    RAVE_CHECK(frame->began_s == static_cast<double>(i - total + 1));
    RAVE_CHECK(std::accumulate(data + i - total + 1, data + i + 1, 0U) % 256 == 0);
    OiState state;
    RAVE_CHECK(read_packets(frame->body, state));
  }
  RAVE_CHECK(decoder.counts().frames == whole);
  RAVE_CHECK(decoder.counts().skipped + whole * decoder.frame_size() <= size - 1);
  return 0;
}
