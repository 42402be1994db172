// SPDX-License-Identifier: Apache-2.0
// Compiled for processors with AVX2; xxhash.h picks its vectors by what the compiler may use.
#include "hash_avx2.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace rave {

std::uint64_t content_hash_avx2(const void* bytes, std::size_t count) noexcept {
  return XXH3_64bits(bytes, count);
}

}  // namespace rave
