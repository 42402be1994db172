// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rave::watch {

/// Resources that a process of this machine uses.
struct ProcessUsage {
  double cpu_s = 0;  ///< Processor time in total.
  double memory_mb = 0;
};

/// Reads them from /proc; empty if there is no such process.
[[nodiscard]] std::optional<ProcessUsage> usage_of(std::uint32_t process);

/// Parses the lines of /proc/PID/stat and /proc/PID/statm (proc(5)); empty if they have another
/// format.
[[nodiscard]] std::optional<ProcessUsage> parse_usage(std::string_view stat, std::string_view statm,
                                                      double ticks_per_s, double page_bytes);

}  // namespace rave::watch
