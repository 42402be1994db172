// SPDX-License-Identifier: Apache-2.0
// The audit log may have been cut off or edited by hand: what is read is bounded and fits the
// filter.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "people/audit_lines.hpp"
#include "rave/base/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::gui_server;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  AuditPage all;
  add_audit_lines(text, {{}, {}, 1000}, all);
  AuditPage logins;
  add_audit_lines(text, {"login", "a", 3}, logins);
  RAVE_CHECK(logins.lines.size() <= 3);
  RAVE_CHECK(logins.lines.size() <= all.lines.size());
  for (const AuditLine& line : logins.lines) RAVE_CHECK(line.what == "login" && !line.time.empty());
  return 0;
}
