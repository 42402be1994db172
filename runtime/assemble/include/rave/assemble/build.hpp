// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Inputs for building a scenario that are not in its files.
struct BuildOptions {
  std::filesystem::path program_runner;  ///< For programs with `isolate: true`.
  LogSink* log = nullptr;                ///< Not owned; must outlive the result.
  /// Clock of live drivers; not owned. Required if the scenario has a live driver.
  const RunClock* live_clock = nullptr;
  /// The robots that this process runs if it is one of several hosts; unset: all.
  std::optional<std::vector<RobotId>> local = std::nullopt;
  /// The catalogue for drivers of robots of other hosts. The result does not refer to it, so it and
  /// its plug-ins may be destroyed afterwards. Not owned; null: `catalogue`.
  plugin::Catalogue* others = nullptr;
};

/// A scenario that is ready for an Engine. The catalogue it was built with must outlive it.
struct BuiltScenario {
  sim::EngineSpec spec;
  std::vector<std::string> robot_kinds;  ///< The `kind` of each robot; empty for none.
  std::string live_reason;  ///< Why the run follows the wall clock; empty if it is stepped.
  /// By type: whether its robots need the poses of other robots, because they have virtual sensors
  /// or keep a distance. Also set for types of other hosts.
  std::vector<std::uint8_t> sees;
  std::vector<std::string> notes;  ///< Remarks for the user, such as unusual mountings.
};

/// Loads the drivers of the scenario, checks parameters, references and poses, and places scattered
/// robots. Errors give file and line.
[[nodiscard]] Result<BuiltScenario> build(const config::ExpandedScenario& scenario,
                                          plugin::Catalogue& catalogue,
                                          const BuildOptions& options);

/// Whether a real-time run with several hosts needs an Environment Manager, because a robot of any
/// host needs the poses of others.
[[nodiscard]] bool needs_manager(const BuiltScenario& built);

/// The stamp that plug-ins of this build must match.
[[nodiscard]] plugin::Stamp host_stamp();

}  // namespace rave::runtime
