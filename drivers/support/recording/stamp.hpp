// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::recording {

/// Stamps later than this (the year 2096) are refused; sums of stamps and offsets cannot overflow.
inline constexpr std::int64_t kLatestStamp_ns = 4'000'000'000'000'000'000;

/// Exact nanoseconds of a non-negative decimal number of seconds with at most nine decimals, such
/// as `1248444175.103`; none if the text is anything else or later than kLatestStamp_ns. Integer
/// arithmetic only: a double keeps these times to 0.2 us, a 32-bit float to 128 s.
[[nodiscard]] std::optional<std::int64_t> parse_stamp_ns(std::string_view text) noexcept;

}  // namespace rave::recording
