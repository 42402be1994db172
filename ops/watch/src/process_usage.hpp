// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::watch {

/// What a process of this machine costs.
struct ProcessUsage {
  double cpu_s = 0;  ///< Time of cores that it has used in all.
  double memory_mb = 0;
};

/// Nothing if there is no such process.
[[nodiscard]] std::optional<ProcessUsage> usage_of(std::uint32_t process);

/// Reads the lines of /proc/PID/stat and /proc/PID/statm (proc(5)); nothing if they are none.
[[nodiscard]] std::optional<ProcessUsage> parse_usage(std::string_view stat, std::string_view statm,
                                                      double ticks_per_s, double page_bytes);

}  // namespace rave::watch
