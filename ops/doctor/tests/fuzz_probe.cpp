// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as what another doctor says.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/doctor/probe.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::doctor;
  const auto probe = parse_probe({reinterpret_cast<const char*>(data), size});
  if (!probe) return 0;
  // What was read is written so that it is read the same.
  const auto again = parse_probe(write_probe(*probe));
  if (!again || *again != *probe) std::abort();
  return 0;
}
