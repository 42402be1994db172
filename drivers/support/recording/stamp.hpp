// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::recording {

/// Later stamps (after the year 2096) are refused, so sums of stamps and offsets cannot overflow.
inline constexpr std::int64_t kLatestStamp_ns = 4'000'000'000'000'000'000;

/// Parses a non-negative decimal number of seconds with at most nine decimals, such as
/// `1248444175.103`, to exact nanoseconds. Empty for any other text and for stamps after
/// kLatestStamp_ns. Integer arithmetic only: a double has a resolution of 0.2 us at these times, a
/// 32-bit float of 128 s.
[[nodiscard]] std::optional<std::int64_t> parse_stamp_ns(std::string_view text) noexcept;

}  // namespace rave::recording
