// SPDX-License-Identifier: Apache-2.0
// Bytes as the list of rules of a packet filter.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rave/doctor/checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(
      rave::doctor::check_ruleset({reinterpret_cast<const char*>(data), size}, 0, "lo"));
  return 0;
}
