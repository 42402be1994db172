// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_code.hpp"

namespace rave::scip {
namespace {

// SCIP 2.0 writes numbers in printable characters of six bits each, offset by 0x30, the most
// significant first.
constexpr std::uint32_t kFirst = 0x30;
constexpr std::uint32_t kBits = 6;
constexpr std::uint32_t kMask = (1U << kBits) - 1;
constexpr std::int64_t kTurn_ms = 1 << 24;

}  // namespace

char checksum(std::string_view text) noexcept {
  std::uint32_t sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  return static_cast<char>((sum & kMask) + kFirst);
}

std::optional<std::uint32_t> decode(std::string_view characters) noexcept {
  std::uint32_t value = 0;
  for (const char c : characters) {
    const std::uint32_t digit = static_cast<unsigned char>(c) - kFirst;
    if (digit > kMask) return std::nullopt;
    value = (value << kBits) | digit;
  }
  return value;
}

double UnwrappedTime::seconds(std::uint32_t timer_ms) noexcept {
  const std::int64_t timer = timer_ms % kTurn_ms;
  if (last_ms_ < 0) {
    last_ms_ = timer;
  } else {
    std::int64_t step_ms = (timer - last_ms_) % kTurn_ms;
    if (step_ms >= kTurn_ms / 2) step_ms -= kTurn_ms;
    if (step_ms < -kTurn_ms / 2) step_ms += kTurn_ms;
    last_ms_ += step_ms;
    // A time far before zero would be negative, which means "none yet".
    if (last_ms_ < 0) last_ms_ += kTurn_ms;
  }
  return static_cast<double>(last_ms_) * 1e-3;
}

}  // namespace rave::scip
