// SPDX-License-Identifier: Apache-2.0
#include "recording/stamp.hpp"

namespace rave::recording {

std::optional<std::int64_t> parse_stamp_ns(std::string_view text) noexcept {
  constexpr int kDecimals = 9;
  std::int64_t value = 0;
  int decimals = -1;  // negative before the decimal point
  int digits = 0;
  for (const char c : text) {
    if (c == '.' && decimals < 0) {
      decimals = 0;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    if (decimals == kDecimals || value > kLatestStamp_ns / 10) return std::nullopt;
    value = value * 10 + (c - '0');
    ++digits;
    if (decimals >= 0) ++decimals;
  }
  if (digits == 0 || decimals == 0) return std::nullopt;
  for (int i = decimals < 0 ? 0 : decimals; i < kDecimals; ++i) {
    if (value > kLatestStamp_ns / 10) return std::nullopt;
    value *= 10;
  }
  if (value > kLatestStamp_ns) return std::nullopt;
  return value;
}

}  // namespace rave::recording
