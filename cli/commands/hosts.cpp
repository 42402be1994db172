// SPDX-License-Identifier: Apache-2.0
#include "commands/hosts.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "error_text.hpp"
#include "parent_watch.hpp"
#include "places.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/control/bus_requests.hpp"
#include "rave/control/commands.hpp"
#include "rave/control/folder.hpp"
#include "rave/host/host_run.hpp"
#include "rave/launch/managed_run.hpp"
#include "rave/launch/run_bus.hpp"
#include "run_scenario.hpp"
#include "run_start.hpp"

namespace rave::cli {
namespace {

/// What `rave robot` and `rave env` end with; the exit code.
int tell(const RunCommand& options, bool whole, const std::string& summary,
         std::vector<std::string> problems, RunStart& start) {
  if (std::string lost = start.console().lost_messages(); !lost.empty()) {
    whole = false;
    problems.push_back(std::move(lost));
  }
  const Terminal errors = terminal_of(stderr);
  if (!options.quiet) put(stdout, summary + fmt::format("{}\n", start.path().string()));
  for (const std::string& problem : problems) {
    put_note(errors.red("problem:"), without_control_characters(problem, " "));
  }
  if (whole && !options.quiet) put(stdout, terminal_of(stdout).green("done") + "\n");
  return whole ? kGood : kNotGood;
}

}  // namespace

Result<int> robot(const RobotCommand& options) {
  const RunCommand& run = options.run;
  RAVE_TRY_ASSIGN(auto scenario, read_scenario(run));
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(run.plugins));
  const std::string name = fmt::format("{}-{}", scenario.scenario.name.value, options.host);
  runtime::HostOptions how;
  RAVE_TRY_ASSIGN(how.others, open_catalogue(run.plugins));
  how.host = options.host;
  how.manager_patience = from_seconds(options.manager_patience_s);
  RAVE_TRY_ASSIGN(how.bus, launch::bus_of_run(run.bus, options.host, scenario, bus::Reach::kHubs));
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(run, name));
  RunStart& start = *opened;
  runtime::RunControl& control = start.control();
  how.run =
      start.run_options(run, control::own_run_name(scenario.scenario.name.value, options.host));
  control::ManagerRelay relay(how.bus);
  how.begin_request = control::bus_requests_of(control, &relay);
  RAVE_TRY_ASSIGN(how.begin_command, control::commands_of(control, scenario, options.host));
  start.serve(how.run.run_name, "host", "this host");
  ParentWatch parent;
  if (run.with_parent) {
    RAVE_TRY(parent.start(how.bus, how.manager_patience, control, start.console()));
  }
  const auto line =
      launch::open_host_line(run.line, options.host, how.bus, control, start.console());
  if (!line) {
    start.discard();
    return tl::unexpected(line.error());
  }
  const auto outcome = runtime::run_host(scenario, *catalogue, std::move(how));
  // What a run left that broke off tells why.
  std::error_code error;
  if (!outcome && !std::filesystem::exists(start.path() / "run.mcap", error)) start.discard();
  if (!outcome) return tl::unexpected(outcome.error());
  const std::string ending = outcome->ending.empty() ? "" : ", " + outcome->ending;
  return tell(run, outcome->whole,
              fmt::format("host {}: {} steps{}\n", options.host, outcome->steps, ending),
              outcome->problems, start);
}

Result<int> env(const EnvCommand& options) {
  const RunCommand& run = options.run;
  RAVE_TRY_ASSIGN(auto scenario, read_scenario(run));
  RAVE_TRY_ASSIGN(auto bus,
                  launch::bus_of_run(run.bus, "environment manager", scenario, bus::Reach::kHub));
  const std::string& name = scenario.scenario.name.value;
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(run, name + "-env"));
  RunStart& start = *opened;
  Console& console = start.console();
  runtime::RunControl& control = start.control();
  start.serve(control::own_run_name(name), "run", "this run");
  bool started = false;
  auto managed = launch::manage_run(
      {.scenario = scenario,
       .settings = run,
       .bus = bus,
       .folder = start.path(),
       .log = console,
       .control = control,
       .stopping =
           [&] {
             started = true;
             return control.stopping();
           },
       .resume = options.resume,
       .on_progress = [&console](const report::Progress& progress) { console.show(progress); }});
  console.clear();
  if (!managed && !started) start.discard();
  if (!managed) return tl::unexpected(managed.error());
  RAVE_TRY_ASSIGN(const auto outcome, managed->results->write(managed->end));
  // A host that sent nothing is a problem; a check that could not be made has not failed.
  return tell(run, outcome.whole && !outcome.checks_fail, outcome.summary, outcome.problems, start);
}

}  // namespace rave::cli
