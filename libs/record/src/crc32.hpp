// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rave::record {

/// CRC-32 of IEEE 802.3, zlib and MCAP. `crc32(b, crc32(a))` is the CRC of a followed by b.
[[nodiscard]] std::uint32_t crc32(std::span<const std::byte> bytes,
                                  std::uint32_t before = 0) noexcept;

}  // namespace rave::record
