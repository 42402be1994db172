// SPDX-License-Identifier: Apache-2.0
#include "commands/run.hpp"

#include <sys/prctl.h>

#include <csignal>

#include "places.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/folder.hpp"
#include "rave/gui_server/live_run.hpp"
#include "rave/gui_server/run_lines.hpp"
#include "rave/host/run.hpp"
#include "run_people.hpp"
#include "run_plan.hpp"
#include "run_report.hpp"
#include "run_scenario.hpp"
#include "run_start.hpp"
#include "shared_run.hpp"

namespace rave::cli {
namespace {

/// The direct line of a run of this process; none if none is asked for.
Result<std::unique_ptr<direct_line::LineServer>> open_line(const RunCommand& options,
                                                           const config::ExpandedScenario& scenario,
                                                           gui_server::GuiServer* page,
                                                           RunStart& start) {
  if (!options.line.web) return nullptr;
  if (page == nullptr) {
    return fail(ErrorCode::kInvalidArgument, "--web: a run of one process also needs --gui");
  }
  RAVE_TRY_ASSIGN(auto line, launch::line_options(options.line, start.console()));
  return gui_server::open_line_here(std::move(line), scenario, start.control(), *page);
}

/// A run whose robots all belong to this process.
Result<int> run_alone(const RunCommand& options, config::ExpandedScenario& scenario) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  const std::string& name = scenario.scenario.name.value;
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(options, name));
  RunStart& start = *opened;
  RAVE_TRY_ASSIGN(const auto companions, start_companions(options, scenario, start));
  Console& console = start.console();
  runtime::RunControl& control = start.control();
  runtime::RunOptions run_options = start.run_options(options, control::own_run_name(name));
  bool started = false;
  run_options.on_progress = [&](const report::Progress& progress) {
    started = true;
    console.show(progress);
  };
  start.serve(run_options.run_name, "run", "this run");
  PageOptions page_options = options.page;
  RAVE_TRY_ASSIGN(const auto people, RunPeople::of(scenario, page_options));
  std::unique_ptr<gui_server::GuiServer> page;
  std::unique_ptr<plugin::Catalogue> described;
  if (options.gui) {
    RAVE_TRY_ASSIGN(described, open_catalogue(options.plugins));
  }
  gui_server::LiveRun live(
      scenario, control, *catalogue, std::move(described),
      [&page](auto source) { page->show(std::move(source)); },
      find_scenario(options.scenario).value_or(""));
  if (options.gui) {
    RAVE_TRY_ASSIGN(page, serve_page(page_options));
    RAVE_TRY(people->invite(*page));
    run_options.observers.push_back(&live.observer());
  }
  RAVE_TRY_ASSIGN(const auto line, open_line(options, scenario, page.get(), start));
  auto outcome = runtime::run(scenario, *catalogue, run_options);
  console.clear();
  end_companions(*companions, outcome);
  if (outcome) {
    const int code = report_outcome(options, *outcome, start.path(), console);
    live.end("The run has ended.");
    if (page) replay_on_page(*page, options.quiet, start.path(), control);
    return code;
  }
  // What a run left that broke off tells why.
  if (!started) start.discard();
  return tl::unexpected(outcome.error());
}

/// Builds the world without opening a device, as drivers can refuse their parameters.
Result<int> show_plan(const RunCommand& options, const config::ExpandedScenario& scenario,
                      const std::vector<config::PlannedHost>& hosts) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  runtime::BuildOptions how;
  how.program_runner = program_runner();
  RAVE_TRY_ASSIGN(const auto built, runtime::build(scenario, *catalogue, how));
  put(stdout, run_plan(options, scenario, hosts, built));
  return kGood;
}

}  // namespace

Result<int> run(const RunCommand& options) {
  // As Ctrl-C: its results are written.
  if (options.with_parent) ::prctl(PR_SET_PDEATHSIG, SIGINT);
  RAVE_TRY_ASSIGN(auto scenario, read_scenario(options));
  if (options.gui && !options.pace) scenario.scenario.pace = config::Pace{1};
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  RAVE_TRY(launch::Companions::find(scenario.scenario.companions, options.program));
  if (options.dry_run) return show_plan(options, scenario, hosts);
  return hosts.empty() ? run_alone(options, scenario) : run_shared(options, scenario, hosts);
}

}  // namespace rave::cli
