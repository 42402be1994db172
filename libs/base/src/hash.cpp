// SPDX-License-Identifier: Apache-2.0
#include "rave/base/hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "hash_avx2.hpp"

namespace rave {

std::uint64_t content_hash(std::span<const std::byte> bytes) noexcept {
#if RAVE_HASH_AVX2
  // Shorter inputs use no vector instructions; the hash is the same either way.
  constexpr std::size_t kVectorsFrom = 241;
  // Asked once; the instructions are used only where they pay.
  static const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
  if (bytes.size() >= kVectorsFrom && kHasAvx2) {
    return content_hash_avx2(bytes.data(), bytes.size());
  }
#endif
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace rave
