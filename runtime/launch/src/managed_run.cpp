// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/managed_run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "host_command.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/file.hpp"
#include "rave/control/bus_requests.hpp"
#include "rave/control/folder.hpp"
#include "rave/host/host_run.hpp"
#include "rave/launch/plugin_folders.hpp"
#include "rave/manager/live_manager.hpp"
#include "rave/manager/manager.hpp"

namespace rave::launch {
namespace {

using manager::LiveManagerOutcome;

/// As many find one another on a machine of two cores.
constexpr std::size_t kMostLiveHosts = 50;

Result<std::unique_ptr<runtime::SharedResults>> results_of(const ManagedRun& run,
                                                           const runtime::BuiltScenario& built) {
  return runtime::SharedResults::begin(
      run.scenario, built,
      {run.folder, !run.settings.no_picture, !run.settings.no_record, &run.log});
}

lock_step::Identity manager_of(const ManagedRun& run, bool real_time) {
  lock_step::Identity self{rave_wire_kNone,
                           "environment manager",
                           0,
                           runtime::shared_number(run.scenario),
                           runtime::interface_stamp(),
                           real_time};
  std::error_code error;
  if (!run.settings.no_record) self.folder = std::filesystem::absolute(run.folder, error).string();
  return self;
}

/// How each host is started again by hand, if that is not done by `rave run`.
std::vector<std::string> commands_of(const ManagedRun& run,
                                     const std::vector<config::PlannedHost>& hosts) {
  const bool restarts =
      run.hosts_ended && run.scenario.scenario.on_lost_host == config::LostHost::kRestart;
  std::vector<std::string> commands;
  for (const config::PlannedHost& host : hosts) {
    const bool by_itself = restarts && !host.elsewhere;
    commands.push_back(by_itself ? "" : host_command(run.settings, host.name, run.bus.run));
  }
  return commands;
}

/// Whether it continues a run that has lost its manager.
bool resumes(const ManagedRun& run) {
  return run.resume || run.scenario.scenario.on_lost_host == config::LostHost::kRestart;
}

/// Options of a manager that are the same in lock-step and in real time.
manager::ManagerRunOptions options_of(const ManagedRun& run, std::vector<config::PlannedHost> hosts,
                                      bool real_time) {
  manager::ManagerRunOptions how;
  how.bus = run.bus;
  how.identity = manager_of(run, real_time);
  how.scenario = run.scenario.scenario.name.value;
  how.commands = commands_of(run, hosts);
  how.hosts = std::move(hosts);
  how.host_timeout = from_seconds(run.scenario.scenario.host_timeout_s);
  how.resume = resumes(run);
  how.log = &run.log;
  how.stopping = run.stopping;
  how.control = &run.control;
  how.begin_request = control::bus_requests_of(run.control);
  return how;
}

/// What processes of hosts have sent goes to the host that it is of.
void take_host_results(std::vector<lock_step::HostResults> host_results, ManagedEnd& end) {
  for (lock_step::HostResults& sent : host_results) {
    // The number comes from another process.
    if (sent.host >= end.end.hosts.size()) continue;
    end.end.hosts[sent.host].results.push_back(std::move(sent.bytes));
  }
}

Result<ManagedEnd> manage_steps(const ManagedRun& run, runtime::BuiltScenario built,
                                std::vector<config::PlannedHost> hosts) {
  ManagedEnd end;
  RAVE_TRY_ASSIGN(end.results, results_of(run, built));
  for (const config::PlannedHost& host : hosts) end.end.hosts.emplace_back().name = host.name;
  const config::ScenarioFile& file = run.scenario.scenario;
  manager::ManagerOptions how{options_of(run, std::move(hosts), false)};
  // Rounded: 0.3 / 0.1 is a little less than 3.
  how.steps = static_cast<std::uint64_t>(std::llround(file.duration_s / file.step_s.value));
  how.on_lost_host = file.on_lost_host;
  how.pace = file.pace.is_max() ? 0 : file.pace.factor;
  how.on_progress = [&run, &file](const manager::ManagerOptions::Progress& progress) {
    const double sim_s = static_cast<double>(progress.step) * file.step_s.value;
    if (run.on_progress)
      run.on_progress(
          {sim_s / file.duration_s, sim_s, file.duration_s.known_end_s(), progress.speed,
           run.scenario.robots.size(),
           progress.waiting.empty() ? std::string() : "waiting for " + progress.waiting});
  };
  // What people say is part of the recording of the world, which the manager writes.
  const auto keep_said = [&run, &end] {
    for (const request::Request& chat : run.control.take_said()) end.results->say(chat);
  };
  how.on_world = [&end, keep_said](const sim::WorldAuthority& authority) {
    keep_said();
    return end.results->after_step(authority);
  };
  how.on_end = [&end, keep_said](const sim::WorldAuthority& authority) {
    keep_said();
    end.results->at_end(authority);
  };
  RAVE_TRY_ASSIGN(auto outcome, manager::manage(std::move(built.spec), how));
  end.end.hash = outcome.hash;
  end.end.steps = outcome.steps;
  end.end.wall_s = outcome.wall_s;
  end.end.lateness = std::move(outcome.lateness);
  end.end.ended_by_hand = outcome.ended_by_hand;
  end.end.problems = std::move(outcome.problems);
  // A run that never began left nothing to wait for.
  for (runtime::SharedHost& host : end.end.hosts) host.awaited = outcome.steps > 0;
  take_host_results(std::move(outcome.host_results), end);
  return end;
}

/// Of a run in real time, before it begins.
Result<ManagedEnd> begin_live(const ManagedRun& run, const runtime::BuiltScenario& built) {
  ManagedEnd end;
  end.live = true;
  RAVE_TRY_ASSIGN(end.results, results_of(run, built));
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(run.scenario));
  for (const config::PlannedHost& planned : hosts) {
    end.end.hosts.emplace_back().name = planned.name;
  }
  return end;
}

/// What is known of it then; without a manager the hosts alone know more.
void note_outcome(LiveManagerOutcome outcome, ManagedEnd& end) {
  take_host_results(std::move(outcome.host_results), end);
  for (runtime::SharedHost& host : end.end.hosts) {
    for (const LiveManagerOutcome::Host& met : outcome.hosts) {
      if (met.name != host.name) continue;
      host.awaited = outcome.drained && met.heard;
      host.heard = met.heard;
      host.losses = met.losses;
      if (met.bound_s < 0) continue;
      host.offset_s = met.offset_s;
      host.bound_s = met.bound_s;
    }
  }
  end.end.worlds = outcome.worlds;
  end.end.states = outcome.states;
  end.end.edits = runtime::SharedEdits{outcome.edits.made, outcome.edits.confirmed,
                                       outcome.edits.slowest_s, outcome.edits.sum_s};
  end.end.wall_s = outcome.end.seconds();
  end.end.ended_by_hand = outcome.ended_by_hand;
  end.end.events = std::move(outcome.refused);
  end.end.problems = std::move(outcome.problems);
}

/// Hosts that do not need a manager.
Result<ManagedEnd> wait_for_hosts(const ManagedRun& run, const runtime::BuiltScenario& built) {
  const std::string& name = run.scenario.scenario.name.value;
  if (!run.hosts_ended) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` needs no environment manager: it runs in real time, and no robot has virtual "
                "sensors or keeps a distance; start its hosts with `rave robot`",
                name);
  }
  run.log.info("run", "no robot senses others, so the hosts run independently");
  LiveManagerOutcome outcome;
  const auto began = std::chrono::steady_clock::now();
  // A look now and then: ends of processes, their restarts and a person's signal come by no one
  // way.
  while (!run.stopping() && !run.hosts_ended()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  outcome.ended_by_hand = !run.hosts_ended() && run.control.stopping();
  if (!run.hosts_ended() && !outcome.ended_by_hand) {
    outcome.problems.emplace_back("stopped before the hosts had ended");
  }
  outcome.end = SimTime{
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - began)
          .count()};
  RAVE_TRY_ASSIGN(auto end, begin_live(run, built));
  note_outcome(std::move(outcome), end);
  return end;
}

/// A run of this number of hosts, if they have to find each other.
Status look_at_number(const runtime::BuiltScenario& built, std::size_t hosts) {
  if (hosts <= kMostLiveHosts || built.live_reason.empty() || !runtime::needs_manager(built)) {
    return {};
  }
  return fail(
      ErrorCode::kInvalidArgument,
      "the run has {} hosts; in real time at most {} hosts can find each other; use fewer hosts "
      "with more robots each",
      hosts, kMostLiveHosts);
}

Result<ManagedEnd> manage_time(const ManagedRun& run, runtime::BuiltScenario built,
                               std::vector<config::PlannedHost> hosts) {
  RAVE_TRY(run.control.check_start(built.live_reason));
  if (!runtime::needs_manager(built)) return wait_for_hosts(run, built);
  const config::ScenarioFile& file = run.scenario.scenario;
  run.log.warn("run", "the run is in real time: {}", built.live_reason);
  manager::LiveManagerOptions how{options_of(run, std::move(hosts), true)};
  how.bus.reach = bus::Reach::kAll;
  for (const sim::RobotSpec& robot : built.spec.robots) {
    const sim::RobotType& type = built.spec.types[robot.type];
    // A robot that is handed over during the run has the limits of its other drivers from then on.
    const sim::RobotType& other = built.spec.types[robot.twin.value_or(robot.type)];
    how.robots.push_back(
        {robot.name, type.staleness, type.simulated, robot.twin.has_value(), other.staleness});
  }
  how.step = built.spec.step;
  how.duration = from_seconds(file.duration_s);
  how.world_period = from_seconds(file.world_period_s);
  how.ends_hosts = static_cast<bool>(run.hosts_ended);
  how.on_progress = [&run, &file](SimTime now, double speed, const std::string& waiting) {
    if (run.on_progress)
      run.on_progress({now.seconds() / file.duration_s, now.seconds(),
                       file.duration_s.known_end_s(), speed, run.scenario.robots.size(),
                       waiting.empty() ? std::string() : "without " + waiting});
  };
  RAVE_TRY_ASSIGN(auto end, begin_live(run, built));
  how.on_end = [&end](const world::WorldModel& world) { end.results->learn(world); };
  RAVE_TRY_ASSIGN(auto outcome, manager::manage_live(std::move(built.spec), how));
  note_outcome(std::move(outcome), end);
  return end;
}

}  // namespace

Result<runtime::BuiltScenario> build_world(const config::ExpandedScenario& scenario,
                                           const RunSettings& settings, LogSink& log) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(settings.plugins, settings.program));
  runtime::BuildOptions how;
  how.log = &log;
  // No robot is local: the manager opens no device and starts no program.
  how.local.emplace();
  how.others = catalogue.get();
  return runtime::build(scenario, *catalogue, how);
}

Status check_hosts_fit(const config::ExpandedScenario& scenario, const RunSettings& settings,
                       std::size_t hosts, LogSink& log) {
  if (hosts <= kMostLiveHosts) return {};
  RAVE_TRY_ASSIGN(const auto built, build_world(scenario, settings, log));
  return look_at_number(built, hosts);
}

Result<ManagedEnd> manage_run(const ManagedRun& run) {
  RAVE_TRY(write_private_file_atomically(run.folder / "scenario.yaml",
                                         config::write_expanded(run.scenario)));
  RAVE_TRY_ASSIGN(auto built, build_world(run.scenario, run.settings, run.log));
  RAVE_TRY_ASSIGN(auto hosts, config::plan_hosts(run.scenario));
  if (hosts.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "scenario `{}` has no hosts: expected `hosts:` with names and robots, or "
                "`processes:` with a number; to run it in one process, use `rave run`",
                run.scenario.scenario.name.value);
  }
  RAVE_TRY(look_at_number(built, hosts.size()));
  if (!built.live_reason.empty()) return manage_time(run, std::move(built), std::move(hosts));
  return manage_steps(run, std::move(built), std::move(hosts));
}

}  // namespace rave::launch
