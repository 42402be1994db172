// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/phase_clock.hpp"
#include "rave/swarm/workload.hpp"

namespace rave::swarm {

/// When a measured run ends; one of the two is set.
struct RunEnd {
  std::optional<std::uint64_t> steps;
  std::optional<double> seconds;  ///< Wall time of the measurement.
};

/// What a run of a workload took and came to. Rates are of wall time.
struct SwarmRun {
  Workload workload;
  std::uint64_t steps = 0;           ///< In all; the hash is that of so many.
  std::uint64_t measured_steps = 0;  ///< Without the first ones, in which memory gets warm.
  double wall_s = 0;                 ///< Of the measured steps.
  double steps_per_s = 0;
  double robot_steps_per_s = 0;
  double rays_per_s = 0;
  double rtf = 0;           ///< Simulated time over wall time.
  double startup_s = 0;     ///< Until the first step could begin.
  double rss_mb = 0;        ///< The most memory that was resident at a time, in 10^6 bytes.
  double rss_start_mb = 0;  ///< Resident before the scenario was made: program and libraries.
  double mean_disp_m = 0;   ///< From start to end in a straight line, over all robots.
  /// Over all readings of the last step; no return counts as the largest range.
  double mean_range_m = 0;
  std::uint64_t hash = 0;
  sim::PhaseTimes phases;  ///< Of the measured steps.
};

/// Runs a workload without record, picture or observers, by the same build() as `rave run`.
/// `began` is where the start-up begins to count. Uses the thread of the caller and those that the
/// workload asks for. Errors: those of make_scenario and build, kPlugin if a program or driver
/// fails on the way, kInvalidArgument for an end that is not one.
[[nodiscard]] Result<SwarmRun> run_swarm(const Workload& workload, const RunEnd& end,
                                         plugin::Catalogue& catalogue, LogSink* log,
                                         std::chrono::steady_clock::time_point began);

/// One line of JSON without a newline; docs/benchmarks.md explains the keys.
[[nodiscard]] std::string swarm_json(const SwarmRun& run);

}  // namespace rave::swarm
