// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"

namespace rave::lock_step {

/// Who a process is in a run.
struct Identity {
  std::uint32_t host = 0;  ///< Number of the host in the scenario; kNone: the environment manager.
  std::string name;        ///< 1 to 64 bytes.
  std::uint32_t robots = 0;
  /// All processes of a run must agree on these.
  std::uint64_t scenario = 0;  ///< See scenario_number().
  std::uint64_t interface_stamp = 0;
  bool real_time = false;  ///< Instead of lock-step; on this, too.
  /// When it started, nanoseconds since 1970 by its own clock; 0: introduction() reads the clock.
  std::int64_t started_ns = 0;
  std::uint32_t real_robots = 0;  ///< Of its robots, at the start; see Pulse::count_real().
};

/// A number of what an expanded scenario says; equal scenarios have the same in every process.
[[nodiscard]] std::uint64_t scenario_number(std::string_view expanded) noexcept;

/// What a process tells the others of itself.
[[nodiscard]] bus::HostInfo introduction(const Identity& self);

/// Of two processes for one task, neither of which is in the run yet, whether the other one stays:
/// the one that started first.
[[nodiscard]] bool gives_way(const bus::HostInfo& self, const bus::HostInfo& other) noexcept;

/// Whether a process that says so of itself can be in one run with this one. Error kState says what
/// differs.
[[nodiscard]] Status check_fits(const Identity& self, const bus::HostInfo& other);

}  // namespace rave::lock_step
