// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/watch/scenario_runs.hpp"

namespace rave::client {

/// A run of a scenario on the bus.
struct SoughtRun {
  bus::RunId run;
  config::ExpandedScenario scenario;  ///< With the number of processes of the run.
  /// Its options or files differ from those here.
  bool differs = false;
};

/// Finds the run of a scenario of which only the name is known, whatever its number: `rave run`
/// gives each of its runs another one. One thread.
class RunSeeker {
 public:
  explicit RunSeeker(config::ExpandedScenario scenario);

  /// The newest run of this scenario on the bus of `config`, whose run is ignored; if there is
  /// none, the newest of one with the same name. Nothing: none was found within `patience`. Errors:
  /// those of bus::Bus::open().
  [[nodiscard]] Result<std::optional<SoughtRun>> seek(const bus::BusConfig& config,
                                                      Duration patience,
                                                      const std::stop_token& stop = {});

 private:
  /// The number of processes with which this scenario has that number; 0: as it is.
  [[nodiscard]] std::optional<int> processes_of(std::uint64_t number);

  config::ExpandedScenario scenario_;
  std::map<std::uint64_t, int> known_;  ///< By number of the scenario.
  int tried_ = 1;                       ///< Numbers of processes up to this one are known.
};

}  // namespace rave::client
