// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace rave {

/// content_hash() by wider vectors, for processors that have AVX2. The same value. It takes no
/// class: a function of one that is compiled with it would be called by others too.
[[nodiscard]] std::uint64_t content_hash_avx2(const void* bytes, std::size_t count) noexcept;

}  // namespace rave
