// SPDX-License-Identifier: Apache-2.0
// Bytes as a request: what is read is written and read again as the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/request/request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto request = rave::request::from_json({reinterpret_cast<const char*>(data), size});
  if (!request) return 0;
  const auto again = rave::request::from_json(to_json_line(*request));
  if (!again || !(*again == *request)) std::abort();
  return 0;
}
