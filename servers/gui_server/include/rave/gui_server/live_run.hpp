// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::gui_server {

/// Shows a run of this process in pages: an observer of the run, and a source with the data of the
/// observer. The run never waits for pages.
class LiveRun {
 public:
  /// `control`: of the run; it receives the requests of pages. `ready` is called with the source
  /// when the run is ready, in the thread of the run. Both must outlive the run. `catalogue`: of
  /// the run, must outlive it; `described`: a second catalogue of the same plug-ins, for the thread
  /// of the server; null: no probes. `file`: of the scenario, for panels that are added during the
  /// run; may be empty.
  LiveRun(const config::ExpandedScenario& scenario, runtime::RunControl& control,
          plugin::Catalogue& catalogue, std::unique_ptr<plugin::Catalogue> described,
          std::function<void(std::shared_ptr<Source>)> ready, std::filesystem::path file = {});
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;
  ~LiveRun();

  /// The observer, for RunOptions::observers.
  [[nodiscard]] runtime::RunObserver& observer() noexcept;
  /// Shows in pages that the run has ended, with the reason. Any thread.
  void end(std::string reason);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::gui_server
