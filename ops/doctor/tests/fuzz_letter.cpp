// SPDX-License-Identifier: Apache-2.0
// Bytes from the network as what another doctor says.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "rave/doctor/letter.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave::doctor;
  const auto letter = parse_letter({reinterpret_cast<const char*>(data), size});
  if (!letter) return 0;
  // What was read is written so that it is read the same.
  const auto again = parse_letter(write_letter(*letter));
  if (!again || *again != *letter) std::abort();
  return 0;
}
