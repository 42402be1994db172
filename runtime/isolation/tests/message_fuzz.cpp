// SPDX-License-Identifier: Apache-2.0
// The bytes that a child sends, and the setup that it is sent.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "describe.hpp"
#include "message.hpp"
#include "rave/base/check.hpp"
#include "setup_copy.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::isolation;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (const auto message = parse_message(bytes)) {
    RAVE_CHECK(message->text.size() + sizeof(MessageHead) == size);
    static_cast<void>(at_place(parse_place(message->text)));
  }
  if (const auto copy = SetupCopy::decode(bytes)) {
    RAVE_CHECK(encode_setup((*copy)->order(), (*copy)->setup()).size() <= size);
  }
  return 0;
}
