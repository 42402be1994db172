// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"

namespace rave::lock_step {

/// The identity of a process in a run.
struct Identity {
  std::uint32_t host = 0;  ///< Number of the host in the scenario; kNone: the environment manager.
  std::string name;        ///< 1 to 64 bytes.
  std::uint32_t robots = 0;
  /// All processes of a run must agree on the following.
  std::uint64_t scenario = 0;  ///< See scenario_number().
  std::uint64_t interface_stamp = 0;
  bool real_time = false;  ///< Real time instead of lock-step; also to be agreed on.
  /// Time of its start, nanoseconds since 1970 by its own clock; 0: introduction() reads the clock.
  std::int64_t started_ns = 0;
  /// Number of its real robots at the start; see Pulse::count_real().
  std::uint32_t real_robots = 0;
  /// Absolute path of the folder with its recording, for monitors; empty: it makes none.
  std::string folder{};
};

/// A hash of an expanded scenario; the same in every process.
[[nodiscard]] std::uint64_t scenario_number(std::string_view expanded) noexcept;

/// The message by which a process introduces itself.
[[nodiscard]] bus::HostInfo introduction(const Identity& self);

/// Decides between two processes for the same task, neither of which is in the run yet. Returns
/// true if `other` may stay: it started first.
[[nodiscard]] bool gives_way(const bus::HostInfo& self, const bus::HostInfo& other) noexcept;

/// Checks that a process with this introduction can be in the same run. Error kState lists the
/// differences.
[[nodiscard]] Status check_fits(const Identity& self, const bus::HostInfo& other);

}  // namespace rave::lock_step
