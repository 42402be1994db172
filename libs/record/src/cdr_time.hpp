// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/time.hpp"
#include "rave/record/cdr.hpp"

namespace rave::record {

inline constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// builtin_interfaces/Time: whole seconds, and non-negative nanoseconds.
inline void put_time(CdrWriter& writer, SimTime time) {
  std::int64_t sec = time.ns / kNsPerSecond;
  std::int64_t ns = time.ns % kNsPerSecond;
  if (ns < 0) {
    ns += kNsPerSecond;
    --sec;
  }
  writer.put(static_cast<std::int32_t>(sec));
  writer.put(static_cast<std::uint32_t>(ns));
}

[[nodiscard]] inline SimTime get_time(CdrReader& reader) noexcept {
  const std::int64_t sec = reader.get<std::int32_t>();
  return {sec * kNsPerSecond + reader.get<std::uint32_t>()};
}

}  // namespace rave::record
