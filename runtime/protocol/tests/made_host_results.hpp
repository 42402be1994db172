// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/hash.hpp"
#include "rave/bus/topics.hpp"

namespace rave::lock_step::testing {

/// More than a writer may hold for readers that have not confirmed it, and not a whole number of
/// parts.
inline constexpr std::size_t kMuch = std::size_t{80} * rave_wire_kMaxHostResultsPart + 17;

/// What a host could know of its run.
inline std::vector<std::byte> made_host_results(std::uint32_t host, std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 + i / 251 + host);
  return bytes;
}

/// What peer_lock_step says when it has all of them.
inline std::string whole_line(std::uint32_t host, const std::vector<std::byte>& bytes) {
  return fmt::format("whole {} {} {:016x}", host, bytes.size(), content_hash(bytes));
}

}  // namespace rave::lock_step::testing
