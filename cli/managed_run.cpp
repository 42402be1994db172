// SPDX-License-Identifier: Apache-2.0
#include "managed_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "places.hpp"
#include "rave/base/file.hpp"
#include "rave/environment_manager/live_manager.hpp"
#include "rave/environment_manager/manager.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/host_run.hpp"
#include "rave/run_control/folder.hpp"

namespace rave::cli {
namespace {

using environment_manager::LiveManagerOutcome;
using environment_manager::ManagerOutcome;

/// The world alone: what the robots do is for their hosts.
Result<robot_host::BuiltScenario> world_of(const ManagedRun& run) {
  plugin::Catalogue catalogue(robot_host::host_stamp());
  RAVE_TRY(add_plugin_folders(run.options.plugins, catalogue));
  robot_host::BuildOptions how;
  how.log = &run.console;
  how.local.emplace();
  how.others = &catalogue;
  return robot_host::build(run.scenario, catalogue, how);
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

std::string summary_of(const config::ExpandedScenario& scenario, const ManagerOutcome& outcome) {
  const double sim_s = static_cast<double>(outcome.steps) * scenario.scenario.step_s.value;
  const double speed = outcome.wall_s > 0 ? sim_s / outcome.wall_s : 0;
  return fmt::format("{}: {} robots, {:.2f} s in {:.2f} s ({:.1f}x), {} contacts\nhash {}\n",
                     scenario.scenario.name.value, scenario.robots.size(), sim_s, outcome.wall_s,
                     speed, outcome.contacts,
                     outcome.hash ? hash_text(outcome) : "none: the run was not whole");
}

lock_step::Identity manager_of(const config::ExpandedScenario& scenario, bool real_time) {
  return {rave_wire_kNone,
          "environment manager",
          0,
          robot_host::shared_number(scenario),
          robot_host::interface_stamp(),
          real_time};
}

Result<ManagedEnd> manage_steps(const ManagedRun& run, sim::EngineSpec spec,
                                std::vector<config::PlannedHost> hosts) {
  const config::ScenarioFile& file = run.scenario.scenario;
  environment_manager::ManagerOptions how;
  how.bus = run.bus;
  how.identity = manager_of(run.scenario, false);
  how.scenario = file.name.value;
  how.hosts = std::move(hosts);
  how.steps = static_cast<std::uint64_t>(std::llround(file.duration_s / file.step_s.value));
  how.on_lost_host = file.on_lost_host;
  how.host_timeout = from_seconds(file.host_timeout_s);
  how.pace = file.pace.is_max() ? 0 : file.pace.factor;
  how.log = &run.console;
  how.stopping = run.stopping;
  how.control = &run.control;
  how.on_progress = [&run, &file](const environment_manager::ManagerOptions::Progress& progress) {
    const double sim_s = static_cast<double>(progress.step) * file.step_s.value;
    run.console.show({sim_s / file.duration_s, sim_s, file.duration_s, progress.speed,
                      run.scenario.robots.size(),
                      progress.waiting.empty() ? std::string() : "waits for " + progress.waiting});
  };
  RAVE_TRY_ASSIGN(auto outcome, environment_manager::manage(std::move(spec), how));
  RAVE_TRY(write_result(run, outcome));
  return ManagedEnd{outcome.whole, false, outcome.problems, summary_of(run.scenario, outcome)};
}

Status write_result(const ManagedRun& run, const LiveManagerOutcome& outcome,
                    const std::string& live_reason) {
  nlohmann::ordered_json json;
  json["scenario"] = run.scenario.scenario.name.value;
  json["whole"] = outcome.whole;
  json["end_s"] = outcome.end.seconds();
  json["hash"] = nullptr;
  json["no_hash_because"] = live_reason;
  json["robots"] = run.scenario.robots.size();
  json["worlds"] = outcome.worlds;
  json["states"] = outcome.states;
  const LiveManagerOutcome::Edits& edits = outcome.edits;
  const bool measured = edits.confirmed > 0;
  json["edits"] = edits.made;
  json["edits_confirmed_by_all"] = edits.confirmed;
  json["edit_slowest_s"] = measured ? nlohmann::ordered_json(edits.slowest_s) : nullptr;
  json["edit_mean_s"] =
      measured ? nlohmann::ordered_json(edits.sum_s / static_cast<double>(edits.confirmed))
               : nullptr;
  json["hosts"] = nlohmann::ordered_json::array();
  for (const LiveManagerOutcome::Host& host : outcome.hosts) {
    const bool known = host.bound_s >= 0;
    nlohmann::ordered_json entry;
    entry["name"] = host.name;
    entry["heard"] = host.heard;
    entry["losses"] = host.losses;
    entry["clock_offset_s"] = known ? nlohmann::ordered_json(host.offset_s) : nullptr;
    entry["clock_bound_s"] = known ? nlohmann::ordered_json(host.bound_s) : nullptr;
    json["hosts"].push_back(std::move(entry));
  }
  json["problems"] = outcome.problems;
  return write_file_atomically(run.folder / "result.json", json.dump(2) + "\n");
}

std::string summary_of(const config::ExpandedScenario& scenario, const LiveManagerOutcome& outcome,
                       const std::string& live_reason) {
  return fmt::format(
      "{}: {} robots on {} hosts, in real time to {:.2f} s, {} worlds\nhash none: {}\n",
      scenario.scenario.name.value, scenario.robots.size(), outcome.hosts.size(),
      outcome.end.seconds(), outcome.worlds, live_reason);
}

/// Hosts that need nobody.
Result<ManagedEnd> wait_for_hosts(const ManagedRun& run, const std::string& live_reason) {
  const std::string& name = run.scenario.scenario.name.value;
  if (!run.hosts_ended) {
    return fail(ErrorCode::kInvalidArgument,
                "the run of `{}` is in real time and no robot in it has virtual sensors or keeps a "
                "distance, so it needs no environment manager: start its hosts with `rave robot`",
                name);
  }
  run.console.info("run", "no robot looks at others, so the hosts go by themselves");
  LiveManagerOutcome outcome;
  // A look now and then: ends of processes, their restarts and a person's signal come by no one
  // way.
  while (!run.stopping() && !run.hosts_ended()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  if (!run.hosts_ended()) outcome.problems.emplace_back("stopped before its hosts had ended");
  outcome.whole = outcome.problems.empty();
  RAVE_TRY(write_result(run, outcome, live_reason));
  return ManagedEnd{outcome.whole, true, outcome.problems,
                    fmt::format("{}: {} robots, in real time, without a manager\nhash none: {}\n",
                                name, run.scenario.robots.size(), live_reason)};
}

Result<ManagedEnd> manage_time(const ManagedRun& run, robot_host::BuiltScenario built,
                               std::vector<config::PlannedHost> hosts) {
  if (!robot_host::needs_manager(built)) return wait_for_hosts(run, built.live_reason);
  const config::ScenarioFile& file = run.scenario.scenario;
  run.console.warn("run", "the run goes at real time, because {}", built.live_reason);
  environment_manager::LiveManagerOptions how;
  how.bus = run.bus;
  how.identity = manager_of(run.scenario, true);
  how.scenario = file.name.value;
  how.hosts = std::move(hosts);
  for (const sim::RobotSpec& robot : built.spec.robots) {
    const sim::RobotType& type = built.spec.types[robot.type];
    how.robots.push_back({robot.name, type.staleness, type.simulated});
  }
  how.step = built.spec.step;
  how.duration = from_seconds(file.duration_s);
  how.world_period = from_seconds(file.world_period_s);
  how.host_timeout = from_seconds(file.host_timeout_s);
  how.ends_hosts = static_cast<bool>(run.hosts_ended);
  how.log = &run.console;
  how.stopping = run.stopping;
  how.control = &run.control;
  how.on_progress = [&run, &file](SimTime now, const std::string& waiting) {
    run.console.show({now.seconds() / file.duration_s, now.seconds(), file.duration_s, 1,
                      run.scenario.robots.size(),
                      waiting.empty() ? std::string() : "without " + waiting});
  };
  RAVE_TRY_ASSIGN(auto outcome, environment_manager::manage_live(std::move(built.spec), how));
  RAVE_TRY(write_result(run, outcome, built.live_reason));
  return ManagedEnd{outcome.whole, true, outcome.problems,
                    summary_of(run.scenario, outcome, built.live_reason)};
}

}  // namespace

std::unique_ptr<run_control::Server> serve_control(const std::string& scenario,
                                                   robot_host::RunControl& control, LogSink& log) {
  auto server = run_control::Server::start(run_control::own_run_name(scenario), control);
  if (server) return *std::move(server);
  log.warn("run", "no other terminal can control this run: {}", server.error().message);
  return nullptr;
}

Result<ManagedEnd> manage_run(const ManagedRun& run) {
  RAVE_TRY(
      write_file_atomically(run.folder / "scenario.yaml", config::write_expanded(run.scenario)));
  RAVE_TRY_ASSIGN(auto built, world_of(run));
  RAVE_TRY_ASSIGN(auto hosts, config::plan_hosts(run.scenario));
  if (hosts.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "the scenario `{}` has no hosts: expected `hosts:` with names and robots, or "
                "`processes:` with a number; `rave run` needs neither",
                run.scenario.scenario.name.value);
  }
  if (!built.live_reason.empty()) return manage_time(run, std::move(built), std::move(hosts));
  return manage_steps(run, std::move(built.spec), std::move(hosts));
}

}  // namespace rave::cli
