// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "rave/bus/topics.hpp"

namespace rave::lock_step {

/// How a run goes, as one of its processes knows it (topics rave/run and rave/host_run).
struct RunReport {
  std::string_view scenario{};
  rave_wire_RunPhase phase = rave_wire_RUN_GATHERING;
  std::uint64_t step = 0;
  std::uint64_t steps = 0;  ///< Of the run.
  double step_s = 0;
  double speed = 0;         ///< Simulated seconds per second.
  std::string_view text{};  ///< What it waits for, or how it ended; what is too long is cut off.
};

/// A process of the run, of whose clock nothing is known.
[[nodiscard]] rave_wire_HostSight process_sight(std::uint32_t host, std::string_view name,
                                                rave_wire_HostPhase phase, std::uint64_t step,
                                                std::uint32_t robots = 0);

/// Fills the message, which borrows `hosts`. Thread-safe.
void fill(rave_wire_RunState& message, const RunReport& report,
          std::span<rave_wire_HostSight> hosts);

}  // namespace rave::lock_step
