// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "commands/run.hpp"
#include "console.hpp"
#include "rave/bus/config.hpp"
#include "rave/environment_manager/manager.hpp"

namespace rave::cli {

/// A run whose environment manager is this process.
struct ManagedRun {
  const config::ExpandedScenario& scenario;
  const RunCommand& options;
  const bus::BusConfig& bus;
  std::filesystem::path folder;  ///< Gets scenario.yaml and result.json.
  Console& console;
  std::function<bool()> stopping;
};

/// Builds the world, waits for the hosts and manages the run to its end. No plug-in stays loaded
/// while it goes. Errors: those of robot_host::build() and environment_manager::manage().
[[nodiscard]] Result<environment_manager::ManagerOutcome> manage_run(const ManagedRun& run);

/// A few lines for people: steps, speed, contacts, hash.
[[nodiscard]] std::string summary_of(const config::ExpandedScenario& scenario,
                                     const environment_manager::ManagerOutcome& outcome);

}  // namespace rave::cli
