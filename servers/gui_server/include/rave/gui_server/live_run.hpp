// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::gui_server {

/// A run of this process, for pages: an observer of the run, and the source that shows what the
/// observer hands over. The run never waits for the pages.
class LiveRun {
 public:
  /// `control` is that of the run: what pages ask for goes there. `ready` gets the source when the
  /// run is there, in the thread of the run. Both outlive the run.
  /// `catalogue`: of the run, outlives it; `described`: another one of the same plug-ins, for the
  /// thread of the server. With a null one nobody tries virtual sensors.
  LiveRun(const config::ExpandedScenario& scenario, runtime::RunControl& control,
          plugin::Catalogue& catalogue, std::unique_ptr<plugin::Catalogue> described,
          std::function<void(std::shared_ptr<Source>)> ready);
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;
  ~LiveRun();

  /// For RunOptions::observers.
  [[nodiscard]] runtime::RunObserver& observer() noexcept;
  /// The run is over: pages say so, with the reason. Any thread.
  void end(std::string reason);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::gui_server
