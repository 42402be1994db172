// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/gui_server/gui_server.hpp"

namespace rave::gui_server {

/// Opens the direct line of a run in this process; `page` issues tickets for it. Destroy the line
/// before `control`. `options` without signer, run and host. Errors: those of LineServer::start().
[[nodiscard]] Result<std::unique_ptr<direct_line::LineServer>> open_line_here(
    direct_line::LineOptions options, const config::ExpandedScenario& scenario,
    runtime::RunControl& control, GuiServer& page);

/// Lets a page of a run on a bus issue tickets for the lines of its hosts. Errors: those of
/// direct_line::lines_on_bus().
[[nodiscard]] Status offer_bus_lines(const config::ExpandedScenario& scenario,
                                     const bus::BusConfig& bus, const direct_line::SigningKey& key,
                                     GuiServer& page);

}  // namespace rave::gui_server
