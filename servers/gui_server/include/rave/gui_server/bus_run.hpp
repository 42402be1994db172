// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "rave/assemble/build.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::gui_server {

/// Called once, in a thread of the source, when the run is over and all its hosts have left.
/// `replay`: a source that plays its recordings, or null; then pages show `where`, a sentence with
/// the places of the recordings.
using OnOver = std::function<void(std::shared_ptr<Source> replay, const std::string& where)>;

/// A source for a run with several processes: joins its bus as a monitor, so that no process of the
/// run waits for it. It may join and leave at any time, and so may processes of the run.
///
/// `built`: of the scenario, for the appearance of robots; not referred to later. `bus`: that of
/// the run. `described`: the plug-ins of the run, for the thread of the server; null: no probes.
/// `control`: of the run's Environment Manager in lock-step, if it is in this process; must outlive
/// the source. Null: robots are stopped, and a run in lock-step is paused, over the bus. `file`: of
/// the scenario, for panels that are added during the run; may be empty. `on_over` may be empty.
/// Errors: those of bus::Bus::open().
[[nodiscard]] Result<std::shared_ptr<Source>> watch_run(
    const config::ExpandedScenario& scenario, const runtime::BuiltScenario& built,
    bus::BusConfig bus, std::unique_ptr<plugin::Catalogue> described,
    runtime::RunControl* control = nullptr, const std::filesystem::path& file = {},
    OnOver on_over = {});

}  // namespace rave::gui_server
