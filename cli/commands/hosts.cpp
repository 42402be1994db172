// SPDX-License-Identifier: Apache-2.0
#include "commands/hosts.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "console.hpp"
#include "error_text.hpp"
#include "interrupt.hpp"
#include "managed_run.hpp"
#include "places.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/control/bus_requests.hpp"
#include "rave/control/commands.hpp"
#include "rave/control/folder.hpp"
#include "rave/control/server.hpp"
#include "rave/host/host_run.hpp"
#include "run_scenario.hpp"

namespace rave::cli {
namespace {

/// What `rave robot` and `rave env` end with; the exit code.
int tell(const RunCommand& options, bool whole, const std::string& summary,
         const std::vector<std::string>& problems, const std::filesystem::path& folder) {
  const Terminal errors = terminal_of(stderr);
  if (!options.quiet) put(stdout, summary + fmt::format("{}\n", folder.string()));
  for (const std::string& problem : problems) {
    put(stderr,
        fmt::format("{} {}\n", errors.red("problem:"), without_control_characters(problem, " ")));
  }
  if (whole && !options.quiet) put(stdout, terminal_of(stdout).green("done") + "\n");
  return whole ? kGood : kNotGood;
}

Result<bus::BusConfig> bus_of_run(const BusOptions& options, const std::string& participant,
                                  const config::ExpandedScenario& scenario, bus::Reach reach) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  RAVE_TRY_ASSIGN(auto bus, bus_config(options, participant, runtime::shared_number(scenario)));
  make_room(bus, hosts.size(), reach);
  return bus;
}

}  // namespace

int robot(const RobotCommand& options) {
  const RunCommand& run = options.run;
  auto scenario = read_scenario(run);
  if (!scenario) return complain(scenario.error());
  plugin::Catalogue catalogue(runtime::host_stamp());
  auto others = std::make_unique<plugin::Catalogue>(runtime::host_stamp());
  for (plugin::Catalogue* const each : {&catalogue, others.get()}) {
    if (auto added = add_plugin_folders(run.plugins, *each); !added) {
      return complain(added.error());
    }
  }
  const std::string name = fmt::format("{}-{}", scenario->scenario.name.value, options.host);
  runtime::HostOptions how;
  how.host = options.host;
  how.manager_patience = from_seconds(options.manager_patience_s);
  how.others = std::move(others);
  auto bus = bus_of_run(run.bus, options.host, *scenario, bus::Reach::kHubs);
  if (!bus) return complain(bus.error());
  how.bus = *bus;
  const auto folder = RunFolder::create(wanted_folder(run), name);
  if (!folder) return complain(folder.error());
  Console console(run.quiet);
  if (auto opened = console.open_file(folder->path() / "console.log"); !opened) {
    return complain(opened.error());
  }
  runtime::RunControl& control = ended_by_signals();
  how.run.output = folder->path();
  how.run.program_runner = program_runner();
  how.run.record = !run.no_record;
  how.run.picture = !run.no_picture;
  how.run.log = &console;
  how.run.control = &control;
  how.run.arm = run.arm;
  how.run.run_name = control::own_run_name(scenario->scenario.name.value, options.host);
  how.begin_request = control::bus_requests_of(control);
  how.on_command = control::commands_of(control, *scenario);
  auto server = control::Server::start(how.run.run_name, control);
  if (!server) {
    console.warn("host", "this host cannot be controlled from other terminals: {}",
                 server.error().message);
  }
  const auto line = open_host_line(run.line, options.host, *bus, control, console);
  if (!line) {
    folder->discard();
    return complain(line.error());
  }
  const auto outcome = runtime::run_host(*scenario, catalogue, std::move(how));
  // What a run left that broke off tells why.
  std::error_code error;
  if (!outcome && !std::filesystem::exists(folder->path() / "run.mcap", error)) folder->discard();
  if (!outcome) return complain(outcome.error());
  return tell(run, outcome->whole, fmt::format("host {}: {} steps\n", options.host, outcome->steps),
              outcome->problems, folder->path());
}

int env(const EnvCommand& options) {
  const RunCommand& run = options.run;
  auto scenario = read_scenario(run);
  if (!scenario) return complain(scenario.error());
  auto bus = bus_of_run(run.bus, "environment manager", *scenario, bus::Reach::kHub);
  if (!bus) return complain(bus.error());
  const auto folder = RunFolder::create(wanted_folder(run), scenario->scenario.name.value + "-env");
  if (!folder) return complain(folder.error());
  Console console(run.quiet);
  if (auto opened = console.open_file(folder->path() / "console.log"); !opened) {
    return complain(opened.error());
  }
  runtime::RunControl& control = ended_by_signals();
  const auto server = serve_control(scenario->scenario.name.value, control, console);
  const auto line = open_host_line(run.line, direct_line::kManagerHost, *bus, control, console);
  if (!line) {
    folder->discard();
    return complain(line.error());
  }
  bool started = false;
  auto managed = manage_run({*scenario,
                             run,
                             *bus,
                             folder->path(),
                             console,
                             control,
                             [&] {
                               started = true;
                               return control.stopping();
                             },
                             {},
                             options.resume});
  console.clear();
  if (!managed && !started) folder->discard();
  if (!managed) return complain(managed.error());
  const auto outcome = managed->results->write(managed->end);
  if (!outcome) return complain(outcome.error());
  // A host that sent nothing is a problem; a check that could not be made has not failed.
  return tell(run, outcome->whole && !outcome->checks_fail, outcome->summary, outcome->problems,
              folder->path());
}

}  // namespace rave::cli
