// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/launch/run_settings.hpp"
#include "rave/report/progress.hpp"
#include "rave/results/run_outcome.hpp"

namespace rave::launch {

/// A run of several processes: this process is the environment manager, and starts a `rave robot`
/// for each host that is not elsewhere. Their folders lie in `hosts` of the run's own. Under the
/// policy `restart`, a host that dies is started again. One owner thread.
class SharedRun {
 public:
  struct Options {
    RunSettings settings;
    bus::BusConfig bus;            ///< As of bus_of_own_run().
    std::filesystem::path folder;  ///< For everything that the run leaves; exists (RunFolder).
    LogSink& log;                  ///< Not owned; outlives the run.
    runtime::RunControl& control;  ///< What others ask of the run. Not owned; outlives it.
    /// Called now and then in the thread of finish(); may be empty.
    std::function<void(const report::Progress&)> on_progress{};
  };

  /// Starts the hosts, and logs the command for each that is elsewhere. `scenario` outlives the
  /// run. Errors: those of check_hosts_fit(); kIo (the folder, a process).
  [[nodiscard]] static Result<std::unique_ptr<SharedRun>> start(
      const config::ExpandedScenario& scenario, const std::vector<config::PlannedHost>& hosts,
      Options options);
  SharedRun(const SharedRun&) = delete;
  SharedRun& operator=(const SharedRun&) = delete;
  /// Ends the hosts that still run.
  ~SharedRun();

  /// Manages the run to its end, waits for its hosts and writes what all of them left. Once.
  /// Errors: those of manage_run() and runtime::SharedResults::write().
  [[nodiscard]] Result<runtime::RunOutcome> finish();

 private:
  class Crew;
  SharedRun(const config::ExpandedScenario& scenario, std::size_t hosts, Options options);

  const config::ExpandedScenario& scenario_;
  Options options_;
  std::unique_ptr<Crew> crew_;
};

}  // namespace rave::launch
