// SPDX-License-Identifier: Apache-2.0
#include "commands/run.hpp"

#include <fmt/format.h>

#include "console.hpp"
#include "error_text.hpp"
#include "interrupt.hpp"
#include "places.hpp"
#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/folder.hpp"
#include "rave/control/server.hpp"
#include "rave/gui_server/live_run.hpp"
#include "rave/host/run.hpp"
#include "run_report.hpp"
#include "run_scenario.hpp"
#include "shared_run.hpp"

namespace rave::cli {
int run(const RunCommand& options) {
  auto scenario = read_scenario(options);
  if (!scenario) return complain(scenario.error());
  if (options.gui && !options.pace) scenario->scenario.pace = config::Pace{1};
  const auto hosts = config::plan_hosts(*scenario);
  if (!hosts) return complain(hosts.error());
  if (!hosts->empty()) return run_shared(options, *scenario, *hosts);
  plugin::Catalogue catalogue(runtime::host_stamp());
  if (auto added = add_plugin_folders(options.plugins, catalogue); !added) {
    return complain(added.error());
  }
  const auto folder = RunFolder::create(wanted_folder(options), scenario->scenario.name.value);
  if (!folder) return complain(folder.error());
  Console console(options.quiet);
  if (auto opened = console.open_file(folder->path() / "console.log"); !opened) {
    return complain(opened.error());
  }
  runtime::RunOptions run_options;
  run_options.output = folder->path();
  run_options.program_runner = program_runner();
  run_options.picture = !options.no_picture;
  run_options.record = !options.no_record;
  run_options.log = &console;
  bool started = false;
  run_options.on_progress = [&](const report::Progress& progress) {
    started = true;
    console.show(progress);
  };
  runtime::RunControl& control = ended_by_signals();
  run_options.control = &control;
  run_options.arm = options.arm;
  run_options.run_name = control::own_run_name(scenario->scenario.name.value);
  // A run that nobody can reach goes on, but whoever relies on `rave stop` should know.
  auto server = control::Server::start(run_options.run_name, control);
  if (!server) {
    console.warn("run", "this run cannot be controlled from other terminals: {}",
                 server.error().message);
  }
  std::unique_ptr<gui_server::GuiServer> page;
  std::unique_ptr<plugin::Catalogue> described;
  if (options.gui) {
    described = std::make_unique<plugin::Catalogue>(runtime::host_stamp());
    if (auto added = add_plugin_folders(options.plugins, *described); !added) {
      return complain(added.error());
    }
  }
  gui_server::LiveRun live(*scenario, control, catalogue, std::move(described),
                           [&page](auto source) { page->show(std::move(source)); });
  if (options.gui) {
    auto served = serve_page(options.page);
    if (!served) return complain(served.error());
    page = *std::move(served);
    run_options.observers.push_back(&live.observer());
  }
  HostLineEnds line;
  if (options.line.web) {
    auto opened =
        page ? open_line_here(options.line, *scenario, control, *page, console)
             : fail(ErrorCode::kInvalidArgument, "--web: a run of one process also needs --gui");
    if (!opened) return complain(opened.error());
    line = *std::move(opened);
  }
  const auto outcome = runtime::run(*scenario, catalogue, run_options);
  console.clear();
  if (outcome) {
    const int code = report_outcome(options, *outcome, folder->path());
    live.end("The run has ended.");
    if (page) replay_on_page(*page, options.quiet, folder->path(), control);
    return code;
  }
  // What a run left that broke off tells why.
  if (!started) folder->discard();
  return complain(outcome.error());
}

}  // namespace rave::cli
