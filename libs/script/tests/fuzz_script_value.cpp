// SPDX-License-Identifier: Apache-2.0
// Bytes as a value: what is read is written as the same bytes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "rave/script/value.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  const auto value = rave::script::read_value(bytes);
  if (value && !std::ranges::equal(write_value(*value), bytes)) std::abort();
  return 0;
}
