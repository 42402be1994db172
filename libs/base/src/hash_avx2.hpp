// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace rave {

/// content_hash() with AVX2 instructions; the same value. It uses no class: inline functions
/// compiled for AVX2 in this file could be linked into callers without AVX2.
[[nodiscard]] std::uint64_t content_hash_avx2(const void* bytes, std::size_t count) noexcept;

}  // namespace rave
