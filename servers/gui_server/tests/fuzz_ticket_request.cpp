// SPDX-License-Identifier: Apache-2.0
// Who asks for a ticket sends a key of one size or nothing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "visitors/ticket_request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto request = rave::gui_server::parse_ticket_request(
      std::string_view(reinterpret_cast<const char*>(data), size));
  if (request && request->size() != 65) std::abort();
  return 0;
}
