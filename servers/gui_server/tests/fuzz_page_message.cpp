// SPDX-License-Identifier: Apache-2.0
// Nothing that a page sends may do more than be refused.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "page/page_message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(rave::gui_server::parse_page_message(
      std::string_view(reinterpret_cast<const char*>(data), size)));
  return 0;
}
