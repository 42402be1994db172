// SPDX-License-Identifier: Apache-2.0
#include "crc32.hpp"

#include <zlib.h>

namespace rave::record {

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
  // zlib takes a null pointer for a request for the initial value.
  if (bytes.empty()) return before;
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace rave::record
