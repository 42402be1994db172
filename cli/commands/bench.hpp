// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"
#include "rave/swarm/compare.hpp"
#include "rave/swarm/swarm_run.hpp"

namespace rave::cli {

/// `rave bench swarm`. Without an end it measures for five seconds.
struct BenchSwarmCommand {
  swarm::Workload workload;
  swarm::RunEnd end;
  std::string write;  ///< Folder for the scenario; empty: none.
};

/// Measures a workload and prints a line of JSON. Returns 0, or 2 if it could not be run.
[[nodiscard]] Result<int> bench_swarm(const BenchSwarmCommand& command);

/// `rave bench compare`: measures two builds in turn, without an end as many steps as A does in
/// five seconds. Returns 0, 1 if a run failed or the hashes differ, 2 if a build is missing.
[[nodiscard]] Result<int> bench_compare(const swarm::CompareOptions& command);

}  // namespace rave::cli
