// SPDX-License-Identifier: Apache-2.0
// Bytes as JSON: what is read is written and read again as the same tree.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/codec/json_input.hpp"
#include "rave/codec/text_output.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rave::codec::parse_json;
  const auto node = parse_json({reinterpret_cast<const char*>(data), size});
  if (!node) return 0;
  const auto again = parse_json(rave::codec::to_json_line(*node));
  if (!again || *again != *node) std::abort();
  return 0;
}
