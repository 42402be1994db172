// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"

namespace rave::watch {

/// A run on the bus and its scenario, as its processes announce them.
struct ScenarioRun {
  bus::RunId run;
  std::uint64_t number = 0;     ///< That of the expanded scenario; runtime::shared_number().
  std::string scenario;         ///< Its name; empty until a process has announced it.
  std::int64_t started_ns = 0;  ///< Start of its newest process, by the clock of that machine.
};

/// Returns true to stop the search; argument: a run that is new, or whose scenario is new.
using IsWanted = std::function<bool(const ScenarioRun&)>;

/// Searches for runs in the domain of `config`, whose run is ignored, by what they run. The search
/// ends after `patience`, or a moment after `wanted`, called in the caller's thread, has returned
/// true: a second one may be newer. The newest come first. Errors: those of bus::Bus::open().
[[nodiscard]] Result<std::vector<ScenarioRun>> find_scenario_runs(bus::BusConfig config,
                                                                  Duration patience,
                                                                  const IsWanted& wanted,
                                                                  const std::stop_token& stop = {});

}  // namespace rave::watch
