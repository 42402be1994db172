// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>

namespace rave::record {

/// Whether two stretches of `size` bytes are equal bit for bit: of numbers that are written and
/// read back, not a bit may change.
inline bool same_bits(const void* a, const void* b, std::size_t size) noexcept {
  return std::memcmp(a, b, size) == 0;
}

}  // namespace rave::record
