// SPDX-License-Identifier: Apache-2.0
// What a page says on a line, and what claims to be signed: nothing may do more than be refused,
// and nothing that was not signed may hold.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "line_message.hpp"
#include "page_key.hpp"
#include "rave/direct_line/ticket.hpp"
#include "signed_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::direct_line;
  static const SigningKey kKey = new_signing_key();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(parse_line_message(text));
  if (verify_ticket(text, kKey.open, 0) || verify_withdrawal(text, kKey.open)) std::abort();
  // As if it were signed, for the decoder behind the signature.
  static_cast<void>(verify_ticket(sign_text("ticket", text, kKey), kKey.open, 0));
  static_cast<void>(verify_withdrawal(sign_text("withdrawal", text, kKey), kKey.open));
  if (size > 65 + 64) {
    static_cast<void>(page_key_signed(text.substr(0, 65), text.substr(65, 64), text.substr(129)));
  }
  return 0;
}
