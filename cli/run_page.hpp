// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "commands/run.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/gui_server/bus_run.hpp"

namespace rave::cli {

/// A source for pages that looks on at a run on the bus. `control`, `on_over`: see
/// gui_server::watch_run().
[[nodiscard]] Result<std::shared_ptr<gui_server::Source>> look_on(
    const RunCommand& options, const config::ExpandedScenario& scenario, const bus::BusConfig& bus,
    runtime::RunControl* control, LogSink& log, gui_server::OnOver on_over = {});

/// Lets pages order robots of the run by way of their hosts, if there is a key for that.
[[nodiscard]] Status offer_lines(const RunCommand& options,
                                 const config::ExpandedScenario& scenario,
                                 const bus::BusConfig& bus, gui_server::GuiServer& page);

/// Serves a page that looks on at a run on the bus. `control`: that of its manager, if it is in
/// this process; may be null. `on_over`: see gui_server::watch_run().
[[nodiscard]] Result<std::unique_ptr<gui_server::GuiServer>> show_run(
    const RunCommand& options, const config::ExpandedScenario& scenario, const bus::BusConfig& bus,
    runtime::RunControl* control, LogSink& log, gui_server::OnOver on_over = {});

}  // namespace rave::cli
