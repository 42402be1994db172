// SPDX-License-Identifier: Apache-2.0
#include "run_page.hpp"

#include <utility>

#include "places.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/gui_server/run_lines.hpp"
#include "rave/launch/managed_run.hpp"

namespace rave::cli {

Result<std::shared_ptr<gui_server::Source>> look_on(const RunCommand& options,
                                                    const config::ExpandedScenario& scenario,
                                                    const bus::BusConfig& bus,
                                                    runtime::RunControl* control, LogSink& log,
                                                    gui_server::OnOver on_over) {
  RAVE_TRY_ASSIGN(const auto built, launch::build_world(scenario, options, log));
  // A catalogue of its own, because it belongs to one thread and the page describes drivers in
  // another.
  RAVE_TRY_ASSIGN(auto described, open_catalogue(options.plugins));
  return gui_server::watch_run(scenario, built, bus, std::move(described), control,
                               find_scenario(options.scenario).value_or(""), std::move(on_over));
}

Status offer_lines(const RunCommand& options, const config::ExpandedScenario& scenario,
                   const bus::BusConfig& bus, gui_server::GuiServer& page) {
  if (options.page.line_key.empty()) return {};
  RAVE_TRY_ASSIGN(const auto key, direct_line::read_signing_key(options.page.line_key));
  return gui_server::offer_bus_lines(scenario, bus, key, page);
}

Result<std::unique_ptr<gui_server::GuiServer>> show_run(const RunCommand& options,
                                                        const config::ExpandedScenario& scenario,
                                                        const bus::BusConfig& bus,
                                                        runtime::RunControl* control, LogSink& log,
                                                        gui_server::OnOver on_over) {
  RAVE_TRY_ASSIGN(auto source, look_on(options, scenario, bus, control, log, std::move(on_over)));
  RAVE_TRY_ASSIGN(auto page, serve_page(options.page, std::move(source)));
  RAVE_TRY(offer_lines(options, scenario, bus, *page));
  return page;
}

}  // namespace rave::cli
