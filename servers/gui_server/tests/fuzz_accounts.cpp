// SPDX-License-Identifier: Apache-2.0
// Files of accounts and of rights may have been written by hand: what is read is written the same.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rave/base/check.hpp"
#include "rave/gui_server/accounts.hpp"
#include "visitors/rights_desk.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::gui_server;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto accounts = parse_accounts(text, "accounts")) {
    const auto again = parse_accounts(write_accounts(*accounts), "accounts");
    RAVE_CHECK(again.has_value());
    RAVE_CHECK(write_accounts(*again) == write_accounts(*accounts));
  }
  if (const auto rights = parse_rights(text, "rights")) {
    const auto again = parse_rights(write_rights(*rights), "rights");
    RAVE_CHECK(again.has_value() && again->size() == rights->size());
  }
  return 0;
}
