// SPDX-License-Identifier: Apache-2.0
#include "receive_any.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static_cast<void>(rave::bus::testing::receive_any(std::as_bytes(std::span(data, size))));
  return 0;
}
