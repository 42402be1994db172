// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/assemble/build.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::gui_server {

/// A run of several processes, for pages: joins its bus as an onlooker, so that no process of the
/// run waits for it or takes notice of it. It may come and go, and so may they.
///
/// `built`: of the scenario, for what robots look like; nothing of it is kept. `bus`: that of the
/// run. `described`: the plug-ins of the run, for the thread of the server; null: nobody tries
/// virtual sensors. `control`: of its environment manager in lock-step, if that is in this process;
/// it outlives the source. Null: robots are stopped over the bus, and nobody here can hold the run.
/// Errors: those of bus::Bus::open().
[[nodiscard]] Result<std::shared_ptr<Source>> watch_run(
    const config::ExpandedScenario& scenario, const runtime::BuiltScenario& built,
    bus::BusConfig bus, std::unique_ptr<plugin::Catalogue> described,
    runtime::RunControl* control = nullptr);

}  // namespace rave::gui_server
