// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>

#include "rave/bus/topics.hpp"

/// What managers in lock-step and in real time have in common.
namespace rave::manager {

inline constexpr std::string_view kSource = "environment manager";  ///< In the log.
/// How often they look whether they are to stop, and show how far the run is.
inline constexpr std::chrono::milliseconds kLook{100};
/// How often all processes are told how the run goes.
inline constexpr std::chrono::milliseconds kTell{500};

/// How long they wait at the end for hosts that are still there: until these are gone, and longer
/// if one has not sent yet what it knows of the run.
inline constexpr std::chrono::seconds kFarewell{3};
inline constexpr std::chrono::seconds kLongFarewell{20};

/// Of another manager that gives way to this one.
[[nodiscard]] inline std::string not_listened_to(const bus::HostInfo& other) {
  return fmt::format("a second environment manager, started later on {}, is ignored",
                     other.machine);
}

[[nodiscard]] inline double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace rave::manager
