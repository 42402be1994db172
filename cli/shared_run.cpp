// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/shared_run.hpp"

#include "rave/control/folder.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/launch/run_bus.hpp"
#include "run_page.hpp"
#include "run_people.hpp"
#include "run_report.hpp"
#include "run_start.hpp"
#include "shared_run.hpp"

namespace rave::cli {
namespace {

/// The most hosts with a line that find each other.
constexpr std::size_t kMostLines = 50;

/// Whether the hosts have direct lines: with a page, unless they are too many.
bool wants_lines(const RunCommand& options, std::size_t hosts) {
  return options.line.web.has_value() || (options.gui && hosts <= kMostLines);
}

/// Gives the hosts what they need for a line, and the page the key, unless they were told of.
Status make_lines(RunCommand& options, const std::filesystem::path& folder) {
  launch::LineArguments& line = options.line;
  if (!line.web) {
    line.web = options.page.listen + ":0";
    line.certificate = options.page.certificate;
    line.key = options.page.key;
  }
  if (!line.web_key.empty() || !options.gui) return {};
  if (options.page.line_key.empty()) {
    options.page.line_key = folder / "line_key";
    RAVE_TRY(direct_line::make_key_files(options.page.line_key));
  }
  line.web_key = options.page.line_key + ".pub";
  return {};
}

}  // namespace

Result<int> run_shared(const RunCommand& asked, config::ExpandedScenario& scenario,
                       const std::vector<config::PlannedHost>& hosts) {
  RunCommand options = asked;
  const bool lines = wants_lines(options, hosts.size());
  RAVE_TRY_ASSIGN(const auto bus, launch::bus_of_own_run(options.bus, scenario, hosts, lines));
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(options, scenario.scenario.name.value));
  RunStart& start = *opened;
  Console& console = start.console();
  runtime::RunControl& control = start.control();
  RAVE_TRY_ASSIGN(const auto companions, start_companions(options, scenario, start));
  RAVE_TRY(lines ? make_lines(options, start.path()) : Status());
  RAVE_TRY_ASSIGN(const auto run,
                  launch::SharedRun::start(
                      scenario, hosts,
                      {options, bus, start.path(), console, control,
                       [&console](const report::Progress& progress) { console.show(progress); }}));
  start.serve(control::own_run_name(scenario.scenario.name.value), "run", "this run");
  RAVE_TRY_ASSIGN(const auto people, RunPeople::of(scenario, options.page));
  std::unique_ptr<gui_server::GuiServer> page;
  if (options.gui) {
    RAVE_TRY_ASSIGN(page, show_run(options, scenario, bus, &control, console));
    RAVE_TRY(people->invite(*page));
  }
  auto outcome = run->finish();
  console.clear();
  end_companions(*companions, outcome);
  if (!outcome) return tl::unexpected(outcome.error());
  const int code = report_outcome(options, *outcome, start.path(), console);
  if (page) replay_on_page(*page, options.quiet, start.path(), control);
  return code;
}

}  // namespace rave::cli
