// SPDX-License-Identifier: Apache-2.0
#include "run_start.hpp"

#include <utility>

#include "interrupt.hpp"
#include "places.hpp"

namespace rave::cli {

RunStart::RunStart(launch::RunFolder folder, bool quiet)
    : folder_(std::move(folder)), console_(quiet), control_(ended_by_signals()) {}

Result<std::unique_ptr<RunStart>> RunStart::open(const RunCommand& options, std::string_view name) {
  const launch::WantedFolder wanted{options.output, options.replace,
                                    find_scenario(options.scenario).value_or("")};
  RAVE_TRY_ASSIGN(auto folder, launch::RunFolder::create(wanted, name));
  std::unique_ptr<RunStart> start(new RunStart(std::move(folder), options.quiet));
  // As soon as there is a folder, so that all later messages are in the file, too.
  RAVE_TRY(start->console_.open_file(start->path() / "console.log"));
  if (options.paused) {
    start->control_.pause();
    start->console_.info("run", "paused before the first step; `rave resume` starts it");
  }
  return start;
}

void RunStart::serve(const std::string& run_name, std::string_view source, std::string_view what) {
  // A run without a control socket is still a run: the failure is a warning.
  auto server = control::Server::start(run_name, control_);
  if (server) {
    server_ = *std::move(server);
    return;
  }
  console_.warn(source, "{} cannot be controlled from other terminals: {}", what,
                server.error().message);
}

runtime::RunOptions RunStart::run_options(const RunCommand& options, std::string run_name) {
  runtime::RunOptions run;
  run.output = path();
  run.program_runner = program_runner();
  run.picture = !options.no_picture;
  run.record = !options.no_record;
  run.log = &console_;
  run.control = &control_;
  run.arm = options.arm;
  run.run_name = std::move(run_name);
  return run;
}

Result<std::unique_ptr<launch::Companions>> start_companions(const RunCommand& options,
                                                             config::ExpandedScenario& scenario,
                                                             RunStart& start) {
  const auto folder = launch::Companions::folder_of_run(start.path());
  if (!scenario.scenario.companions.empty()) config::set_work_folder(scenario, folder);
  return launch::Companions::start(scenario.scenario.companions,
                                   {options.program, folder, start.console(), start.control()});
}

void end_companions(launch::Companions& companions, Result<runtime::RunOutcome>& outcome) {
  for (std::string& problem : companions.end()) {
    if (!outcome) return;
    outcome->whole = false;
    outcome->problems.push_back(std::move(problem));
  }
}

}  // namespace rave::cli
