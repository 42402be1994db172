// SPDX-License-Identifier: Apache-2.0
#include "host_session.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "rave/base/file.hpp"
#include "rave/base/names.hpp"
#include "rave/protocol/agreement.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/facts_file.hpp"
#include "rave/results/outcome.hpp"
#include "rave/results/result_parts.hpp"

namespace rave::runtime {
namespace {

void warn(LogSink& log, const Status& told) {
  if (!told) log.warn("roster", "{}", told.error().message);
}

HostOutcome judge(const RunSession& run, const HostSetup& host, const HostExchange& exchange) {
  HostOutcome outcome;
  outcome.live_reason = host.built.live_reason;
  outcome.steps = run.engine.steps_done() - std::min(run.first, run.engine.steps_done());
  outcome.problems = run.losses;
  outcome.problems.insert(outcome.problems.end(), run.problems.begin(), run.problems.end());
  if (run.stopped && outcome.steps == 0) {
    outcome.problems.emplace_back("stopped before the run began");
  } else if (run.stopped) {
    outcome.ending = fmt::format("ended by hand at {:.2f} s", run.engine.time().seconds());
  }
  if (const auto& ending = exchange.ending(); run.ended && ending) {
    outcome.ending = ending->text;
    if (!ending->good) outcome.problems.push_back("the run ended: " + ending->text);
  }
  outcome.whole = outcome.problems.empty();
  return outcome;
}

Status write_results(const RunSession& run, const std::string& host, const HostExchange& exchange,
                     const RunFacts& facts, const HostOutcome& outcome) {
  const std::filesystem::path& folder = run.options.output;
  nlohmann::ordered_json json;
  json["host"] = host;
  json["whole"] = outcome.whole;
  exchange.describe(json, outcome, facts);
  json["events"] = run.events.size();
  if (!facts.shadows.empty()) json["shadows"] = shadows_json(facts.shadows);
  json["ending"] = outcome.ending;
  json["problems"] = outcome.problems;
  Status written = write_private_file_atomically(
      folder / "result.json",
      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  const Status events = write_private_file_atomically(
      folder / "events.log",
      events_log(run.engine.spec(), run.observers.results().kinds, run.events));
  return written ? events : written;
}

/// Leaves what this host knows in its folder, and sends it to the environment manager; the log
/// says so if it does not get there. Errors: kIo (it could not be left; it was sent).
Status leave_facts(const RunSession& run, const HostSetup& host, HostExchange& exchange,
                   RunFacts facts) {
  // In lock-step what concerns no robot is for the manager to note.
  if (!run.live) {
    std::erase_if(facts.events, [](const sim::Event& event) { return !event.robot.valid(); });
  }
  for (std::string& problem : facts.problems) {
    problem = fmt::format("host `{}`: {}", host.options.host, problem);
  }
  const auto bytes = encode_facts(FactsOf{shared_number(host.scenario), host.options.host}, facts);
  // First of all where a process that dies now has them.
  Status written = write_private_file_atomically(
      run.options.output / kFactsFile, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (const Status sent = exchange.deliver(bytes); !sent) {
    run.console.warn("host", "the environment manager did not receive its results: {}",
                     sent.error().message);
  }
  return written;
}

}  // namespace

Result<HostPart> find_host_part(const config::ExpandedScenario& scenario, const std::string& name) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::vector<std::string_view> names;
  for (std::uint32_t h = 0; h < hosts.size(); ++h) {
    names.emplace_back(hosts[h].name);
    if (hosts[h].name != name) continue;
    HostPart part{h, {}};
    for (const std::size_t robot : hosts[h].robots) {
      part.robots.emplace_back(static_cast<std::uint32_t>(robot));
    }
    return part;
  }
  if (hosts.empty()) {
    return fail(ErrorCode::kNotFound,
                "the scenario `{}` has no hosts: expected `hosts:` with names and robots, or "
                "`processes:` with a number",
                scenario.scenario.name.value);
  }
  return fail(ErrorCode::kNotFound, "the scenario `{}` has no host `{}`{}",
              scenario.scenario.name.value, name, suggestion(name, names));
}

std::vector<sim::Event> obstacle_events(const sim::WorldStep& world) {
  std::vector<sim::Event> events;
  for (const sim::ObstacleChange& change : world.obstacles) {
    events.push_back(
        sim::obstacle_event(world.step, change, "", {!change.asked.empty(), change.by}));
  }
  return events;
}

std::uint32_t real_robots(const sim::EngineSpec& spec, std::span<const RobotId> robots) {
  return static_cast<std::uint32_t>(std::ranges::count_if(robots, [&](RobotId robot) {
    return !spec.types[spec.robots[robot.value()].type].simulated;
  }));
}

std::string kept_folder(const RunOptions& run) {
  std::error_code error;
  return run.record ? std::filesystem::absolute(run.output, error).string() : std::string();
}

void introduce_robots(lock_step::Roster& roster, const sim::EngineSpec& spec,
                      std::span<const RobotId> robots, LogSink& log) {
  roster.note(robots);
  warn(log, roster.tell(spec));
}

void keep_roster(lock_step::Roster& roster, const sim::Engine& engine, ObserverList& observers,
                 LogSink& log) {
  for (const sim::Event& event : engine.events()) {
    const bool ours = event.robot.valid() && engine.is_local(event.robot);
    if (ours && event.kind == sim::EventKind::kHandedOver) roster.note(event.robot);
  }
  tell_roster(roster, engine, observers, log);
}

void tell_roster(lock_step::Roster& roster, const sim::Engine& engine, ObserverList& observers,
                 LogSink& log) {
  for (const RobotId robot : observers.take_leased()) roster.note(robot);
  if (!roster.due()) return;
  const auto driver = [&](RobotId robot) -> lock_step::Roster::Driver {
    const auto [name, page] = observers.holder(engine.spec().robots[robot.value()].name);
    return {name, page};
  };
  warn(log, roster.tell(engine.spec(), driver));
}

Result<HostOutcome> run_session(const HostSetup& host, sim::Engine& engine, bus::Bus& bus,
                                const MakeExchange& make, std::function<void()>& on_step_done) {
  const bool live = !host.built.live_reason.empty();
  RunOptions options = host.options.run;
  options.run_id = host.options.bus.run.text();
  // In real time the manager publishes obstacles itself.
  RAVE_TRY_ASSIGN(
      const auto face,
      BusFace::open(bus, host.part.number, !live || !needs_manager(host.built), &host.catalogue));
  const std::vector<RunObserver*> own = {face.get()};
  Descriptor room = take_room_for_results(options.output, engine.spec());
  RAVE_TRY_ASSIGN(const auto observers,
                  ObserverList::open({host.scenario, host.expanded, host.built.robot_kinds, engine,
                                      host.catalogue, options, host.console, host.options.host,
                                      live, live, own}));
  RunSession run(engine, *observers, host.pace, host.scenario.scenario, options, host.console,
                 live);
  const auto exchange = make(run, *face);
  on_step_done = [&run, &exchange] {
    exchange->step_done();
    // The rest of propose() asks drivers for what comes next.
    run.watch.step_begins(run.engine.steps_done());
  };
  const Status went = go_through(run, *exchange);
  RunFacts facts = end_run(run);
  exchange->complete(facts);
  const HostOutcome outcome = judge(run, host, *exchange);
  room.reset();
  // A full disk here is no reason to keep from others what this host knows.
  const Status written = write_results(run, host.options.host, *exchange, facts, outcome);
  const Status left = leave_facts(run, host, *exchange, std::move(facts));
  if (!went) return tl::unexpected(went.error());
  RAVE_TRY(left);
  RAVE_TRY(written);
  return outcome;
}

}  // namespace rave::runtime
