// SPDX-License-Identifier: Apache-2.0
#include "managed_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "places.hpp"
#include "rave/base/file.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/host_run.hpp"

namespace rave::cli {
namespace {

using environment_manager::ManagerOutcome;

/// The world alone: what the robots do is for their hosts.
Result<sim::EngineSpec> world_of(const ManagedRun& run) {
  plugin::Catalogue catalogue(robot_host::host_stamp());
  RAVE_TRY(add_plugin_folders(run.options.plugins, catalogue));
  robot_host::BuildOptions how;
  how.log = &run.console;
  how.local.emplace();
  how.others = &catalogue;
  RAVE_TRY_ASSIGN(auto built, robot_host::build(run.scenario, catalogue, how));
  RAVE_TRY(robot_host::check_can_be_shared(built));
  return std::move(built.spec);
}

std::string hash_text(const ManagerOutcome& outcome) {
  return outcome.hash ? fmt::format("{:016x}", *outcome.hash) : std::string();
}

Status write_result(const ManagedRun& run, const ManagerOutcome& outcome) {
  nlohmann::ordered_json json;
  json["scenario"] = run.scenario.scenario.name.value;
  json["whole"] = outcome.whole;
  json["steps"] = outcome.steps;
  json["hash"] = outcome.hash ? nlohmann::ordered_json(hash_text(outcome)) : nullptr;
  json["robots"] = run.scenario.robots.size();
  json["contacts"] = outcome.contacts;
  json["wall_s"] = outcome.wall_s;
  json["problems"] = outcome.problems;
  return write_file_atomically(run.folder / "result.json", json.dump(2) + "\n");
}

}  // namespace

Result<ManagerOutcome> manage_run(const ManagedRun& run) {
  const config::ScenarioFile& file = run.scenario.scenario;
  RAVE_TRY(
      write_file_atomically(run.folder / "scenario.yaml", config::write_expanded(run.scenario)));
  RAVE_TRY_ASSIGN(auto spec, world_of(run));
  environment_manager::ManagerOptions how;
  how.bus = run.bus;
  how.identity = {rave_wire_kNone, "environment manager", 0,
                  robot_host::shared_number(run.scenario), robot_host::interface_stamp()};
  how.scenario = file.name.value;
  RAVE_TRY_ASSIGN(how.hosts, config::plan_hosts(run.scenario));
  if (how.hosts.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "the scenario `{}` has no hosts: expected `hosts:` with names and robots, or "
                "`processes:` with a number; `rave run` needs neither",
                file.name.value);
  }
  how.steps = static_cast<std::uint64_t>(std::llround(file.duration_s / file.step_s.value));
  how.on_lost_host = file.on_lost_host;
  how.host_timeout = from_seconds(file.host_timeout_s);
  how.pace = file.pace.is_max() ? 0 : file.pace.factor;
  how.log = &run.console;
  how.stopping = run.stopping;
  how.on_progress = [&run, &file](const environment_manager::ManagerOptions::Progress& progress) {
    const double sim_s = static_cast<double>(progress.step) * file.step_s.value;
    run.console.show({sim_s / file.duration_s, sim_s, file.duration_s, progress.speed,
                      run.scenario.robots.size(),
                      progress.waiting.empty() ? std::string() : "waits for " + progress.waiting});
  };
  RAVE_TRY_ASSIGN(auto outcome, environment_manager::manage(std::move(spec), how));
  RAVE_TRY(write_result(run, outcome));
  return outcome;
}

std::string summary_of(const config::ExpandedScenario& scenario, const ManagerOutcome& outcome) {
  const double sim_s = static_cast<double>(outcome.steps) * scenario.scenario.step_s.value;
  const double speed = outcome.wall_s > 0 ? sim_s / outcome.wall_s : 0;
  return fmt::format("{}: {} robots, {:.2f} s in {:.2f} s ({:.1f}x), {} contacts\nhash {}\n",
                     scenario.scenario.name.value, scenario.robots.size(), sim_s, outcome.wall_s,
                     speed, outcome.contacts,
                     outcome.hash ? hash_text(outcome) : "none: the run was not whole");
}

}  // namespace rave::cli
