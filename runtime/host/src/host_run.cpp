// SPDX-License-Identifier: Apache-2.0
#include "rave/host/host_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bus_face.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/file.hpp"
#include "rave/control/world_request.hpp"
#include "rave/host/host_journey.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/protocol/host_port.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/radio_report.hpp"
#include "waiting_robots.hpp"
#include "world_account.hpp"

namespace rave::runtime {
namespace {

using lock_step::HostPort;

/// For another manager of a run that lost its own while this process stood still.
constexpr Duration kAfterStandstill = from_seconds(10);

/// A host on its way through a run in lock-step.
struct Journey : HostJourney {
  Journey(HostJourney host, HostPort& to, const config::ExpandedScenario& scenario)
      : HostJourney(std::move(host)), port(to), account(scenario, engine.spec()) {}

  HostPort& port;
  WorldAccount account;
  sim::HostReport report;
  sim::WorldStep world;
  bool came_to_end = false;
  std::uint64_t joined_at = 0;  ///< After the last gap, if there was one.
};

Status propose(Journey& journey) {
  Status status = journey.engine.propose(journey.report);
  // The others shall know why.
  if (!status) journey.port.farewell(journey.report, journey.engine.hash().value());
  return status;
}

/// What was asked of the world by hand counts from the step that comes now on.
void keep_requests(Journey& journey) {
  for (const RunRequest& request : requests_in(journey.engine.spec(), journey.world)) {
    journey.observers.keep(request, journey.world.step);
  }
}

/// Takes the next step of the world in; false: there is none for this host.
Result<bool> take_step(Journey& journey) {
  if (journey.stopping()) {
    journey.stopped = true;
    return false;
  }
  RAVE_TRY_ASSIGN(
      const HostPort::Answer answer,
      journey.port.exchange(journey.report, journey.engine.hash().value(), journey.world, [&] {
        serve_requests(journey);
        // Somebody may look elsewhere while the run is held.
        journey.observers.held(journey.engine);
        return journey.stopping();
      }));
  journey.stopped = answer == HostPort::Answer::kStopped;
  journey.ended = answer == HostPort::Answer::kEnded;
  if (answer != HostPort::Answer::kWorld) return false;
  journey.account.take(journey.world, journey.port.authority());
  const std::uint64_t next = journey.report.step;
  if (journey.world.step > next) {
    std::string text =
        fmt::format("was not there from step {} to step {}", next, journey.world.step);
    journey.console.warn("host", "{}; its robots continue where they stand", text);
    journey.problems.push_back(std::move(text));
    journey.joined_at = journey.world.step;
  }
  if (journey.world.last) {
    journey.came_to_end = true;
    return false;
  }
  keep_requests(journey);
  RAVE_TRY(journey.engine.join(journey.world, journey.port.authority()));
  return true;
}

Status go_through(Journey& journey) {
  RAVE_TRY(propose(journey));
  for (;;) {
    serve_requests(journey);
    RAVE_TRY_ASSIGN(const bool goes_on, take_step(journey));
    if (!goes_on) return {};
    RAVE_TRY(propose(journey));
  }
}

Status write_results(const Journey& journey, const HostOutcome& outcome) {
  const std::filesystem::path& folder = journey.options.run.output;
  nlohmann::ordered_json json;
  json["host"] = journey.options.host;
  json["whole"] = outcome.whole;
  json["steps"] = outcome.steps;
  json["hash_part"] = fmt::format("{:016x}", journey.engine.hash().value());
  json["events"] = journey.events.size();
  json["ending"] = outcome.ending;
  json["problems"] = outcome.problems;
  RAVE_TRY(write_file_atomically(
      folder / "events.log",
      events_log(journey.engine.spec(), journey.observers.results().kinds, journey.events)));
  return write_file_atomically(
      folder / "result.json",
      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

HostOutcome judge(const Journey& journey) {
  HostOutcome outcome;
  outcome.steps = journey.engine.steps_done();
  note_end(journey, journey.port.ending().text, journey.port.ending().good, outcome);
  return outcome;
}

/// What this host knows when all is over. Changes what the engine shows of robots.
RunFacts facts_of(Journey& journey, const std::string& record_problem) {
  RunFacts facts = gather(journey.observers.results(), journey.engine);
  if (!record_problem.empty()) facts.problems.push_back(record_problem);
  // A manager that took over does not know it.
  facts.problems.insert(facts.problems.end(), journey.problems.begin(), journey.problems.end());
  facts.first_step = journey.joined_at;
  if (journey.port.changed_hands()) {
    WorldFacts told = journey.account.facts();
    // Who was not there all along cannot fill the gap of a manager.
    if (told.first_step == 0) facts.world = std::move(told);
  }
  if (!journey.came_to_end || !has_radio(journey.engine.spec())) return facts;
  // Who hears what was sent in the last step is decided with the world after it.
  const bool heard = journey.engine.join(journey.world, journey.port.authority()).has_value();
  if (heard) facts.radio = journey.engine.radio_counts();
  return facts;
}

}  // namespace

Result<HostOutcome> run_host(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                             HostOptions options) {
  RAVE_TRY_ASSIGN(Seat seat, find_seat(scenario, options.host));
  const RunOptions& run = options.run;
  const std::string expanded = config::write_expanded(scenario);
  RAVE_TRY(write_file_atomically(run.output / "scenario.yaml", expanded));
  ConsoleTee console(run.log);
  BuildOptions how{run.program_runner, &console};
  how.local = seat.robots;
  how.others = options.others.get();
  WallPace pace(1);
  how.live_clock = &pace;
  config::ExpandedScenario adjusted = scenario;
  keep_history_for_observers(adjusted.scenario);
  RAVE_TRY_ASSIGN(BuiltScenario built, build(adjusted, catalogue, how));
  options.others.reset();
  if (!built.live_reason.empty()) {
    return run_live_host({scenario, expanded, catalogue, options, seat, console, pace},
                         std::move(built));
  }
  built.spec.live_clock = nullptr;
  for (const std::string& note : built.notes) console.warn("scenario", "{}", note);
  lock_step::Identity self{seat.number, options.host,
                           static_cast<std::uint32_t>(seat.robots.size()), shared_number(scenario),
                           interface_stamp()};
  self.real_robots = real_robots(built.spec, seat.robots);
  std::function<void()> look;
  built.spec.on_step_done = [&look] { look(); };
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  HostPort::Patience patience{options.manager_patience, {}};
  // Under the others a run may have gone on, and ended, while this process stood still.
  if (scenario.scenario.on_lost_host != config::LostHost::kWait) {
    patience.after_standstill = kAfterStandstill;
  }
  RAVE_TRY_ASSIGN(const auto port, HostPort::open(options.bus, std::move(self), &console, patience,
                                                  options.begin_wish));
  port->word().describe(scenario.scenario.name.value, steps_of(scenario.scenario),
                        scenario.scenario.step_s.value);
  introduce_robots(port->roster(), engine->spec(), seat.robots, console);
  RAVE_TRY_ASSIGN(const auto face, BusFace::open(port->bus(), seat.number, true, &catalogue));
  options.run.observers.push_back(face.get());
  RAVE_TRY_ASSIGN(const auto observers,
                  ObserverList::open({scenario, expanded, built.robot_kinds, *engine, catalogue,
                                      run, console, options.host}));
  Journey journey({*engine, *observers, port->roster(), options, console, shared_number(scenario)},
                  *port, scenario);
  journey.report.host = seat.number;
  journey.world_tells = true;
  look = [&journey, &seat] {
    look_back(journey, obstacle_events(journey.world), journey.world.resized, false);
    journey.account.after_step(journey.engine);
    journey.port.show(journey.engine, seat.robots);
  };
  const ControlledHost controlled(*engine, scenario.scenario, run.control, false);
  tell_who_waits(*engine, run, console);
  const Status went = go_through(journey);
  engine->halt();
  const std::string record_problem = observers->end_record(engine->hash().value());
  HostOutcome outcome = judge(journey);
  if (!record_problem.empty()) outcome.problems.push_back(record_problem);
  outcome.whole = outcome.whole && outcome.problems.empty();
  // A full disk here is no reason to keep from others what this host knows.
  const Status written = write_results(journey, outcome);
  RAVE_TRY(leave_facts(journey, encode_facts(journey, facts_of(journey, record_problem)),
                       [&port](std::span<const std::byte> facts) { return port->deliver(facts); }));
  RAVE_TRY(written);
  if (!went) return tl::unexpected(went.error());
  return outcome;
}

}  // namespace rave::runtime
