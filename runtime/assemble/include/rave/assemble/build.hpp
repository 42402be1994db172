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

/// What a scenario is built with that is not in its files.
struct BuildOptions {
  std::filesystem::path program_runner;  ///< For programs with `isolate: true`.
  LogSink* log = nullptr;                ///< Not owned; outlives what is built.
  /// Clock of live drivers; not owned. A scenario with a live driver cannot be built without one.
  const RunClock* live_clock = nullptr;
  /// The robots that this process runs, one of several that share the world; not set: all.
  std::optional<std::vector<RobotId>> local = std::nullopt;
  /// Where the drivers of robots that others run are looked up. What is built keeps nothing of it,
  /// so it may be destroyed afterwards and their plug-ins with it. Not owned; null: `catalogue`.
  plugin::Catalogue* others = nullptr;
};

/// A scenario, ready for an Engine. The catalogue it was built with must outlive it.
struct BuiltScenario {
  sim::EngineSpec spec;
  std::vector<std::string> robot_kinds;  ///< The free word of each robot; empty for none.
  std::string live_reason;  ///< What makes the run one in real time; empty if it is stepped.
  /// By type: a robot of it has use of where others are, since it has virtual sensors or keeps a
  /// distance. Known of the types of other hosts, too.
  std::vector<std::uint8_t> sees;
  std::vector<std::string> notes;  ///< What a careful person would be told, such as odd mountings.
};

/// Loads the drivers that the scenario names, checks parameters, references and places, puts
/// scattered robots down. Errors point at the line of the file that is wrong.
[[nodiscard]] Result<BuiltScenario> build(const config::ExpandedScenario& scenario,
                                          plugin::Catalogue& catalogue,
                                          const BuildOptions& options);

/// Whether a run in real time that several hosts share needs an environment manager: a robot of any
/// of them has use of where others are.
[[nodiscard]] bool needs_manager(const BuiltScenario& built);

/// The stamp that plug-ins of this build must match.
[[nodiscard]] plugin::Stamp host_stamp();

}  // namespace rave::runtime
