// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rave::record {

/// CRC-32 as in IEEE 802.3, zlib and MCAP. `crc32(b, crc32(a))` is the sum over a and b in a row.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes,
                                  std::uint32_t before = 0) noexcept;

}  // namespace rave::record
