// SPDX-License-Identifier: Apache-2.0
// Certificates and signed documents come from files that others may have written.
#include <cstddef>
#include <cstdint>
#include <string>

#include "certificate.hpp"
#include "rave/base/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::keys;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto facts = read_certificate(text);
  if (facts) {
    for (const char c : facts->name + facts->lab) RAVE_CHECK(c >= ' ' && c <= '~');
    static_cast<void>(check_issued(text, text));
    static_cast<void>(signed_text(text, text));
  }
  static_cast<void>(check_pair({text, text}));
  return 0;
}
