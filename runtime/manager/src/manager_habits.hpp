// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>

#include "rave/bus/topics.hpp"

/// Constants that managers in lock-step and in real time share.
namespace rave::manager {

inline constexpr std::string_view kSource = "environment manager";  ///< In the log.
/// Interval between checks for a request to stop, and between updates of the progress.
inline constexpr std::chrono::milliseconds kLook{100};
/// Interval between messages about the state of the run.
inline constexpr std::chrono::milliseconds kTell{500};

/// Wait at the end for hosts that are still present, and the longer one for a host that has not
/// sent its results yet.
inline constexpr std::chrono::seconds kFarewell{3};
inline constexpr std::chrono::seconds kLongFarewell{20};

/// The log message about another manager that gives way to this one.
[[nodiscard]] inline std::string not_listened_to(const bus::HostInfo& other) {
  return fmt::format("a second environment manager, started later on {}, is ignored",
                     other.machine);
}

[[nodiscard]] inline double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace rave::manager
