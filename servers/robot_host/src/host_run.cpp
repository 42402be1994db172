// SPDX-License-Identifier: Apache-2.0
#include "rave/robot_host/host_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "console_tee.hpp"
#include "event_log.hpp"
#include "host_journey.hpp"
#include "rave/base/file.hpp"
#include "rave/lock_step/host_port.hpp"
#include "rave/robot/interface_hash.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/provenance.hpp"
#include "record_keeper.hpp"
#include "wall_pace.hpp"

namespace rave::robot_host {
namespace {

using lock_step::HostPort;

/// A host on its way through a run in lock-step.
struct Journey : HostJourney {
  Journey(HostJourney host, HostPort& to) : HostJourney(std::move(host)), port(to) {}

  HostPort& port;
  sim::HostReport report;
  sim::WorldStep world;
};

Status propose(Journey& journey) {
  const Status status = journey.engine.propose(journey.report);
  // The others shall know why.
  if (!status) journey.port.farewell(journey.report, journey.engine.hash().value());
  return status;
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
        return journey.stopping();
      }));
  journey.stopped = answer == HostPort::Answer::kStopped;
  journey.ended = answer == HostPort::Answer::kEnded;
  if (answer != HostPort::Answer::kWorld) return false;
  const std::uint64_t next = journey.report.step;
  if (journey.world.step > next) {
    std::string text =
        fmt::format("was not there from step {} to step {}", next, journey.world.step);
    journey.console.warn("host", "{}; its robots go on where they stand", text);
    journey.problems.push_back(std::move(text));
  }
  if (journey.world.last) return false;
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
    look_back(journey);
  }
}

Status write_results(const Journey& journey, const BodyKinds& kinds, const HostOutcome& outcome) {
  const std::filesystem::path& folder = journey.options.run.output;
  nlohmann::ordered_json json;
  json["host"] = journey.options.host;
  json["whole"] = outcome.whole;
  json["steps"] = outcome.steps;
  json["hash_part"] = fmt::format("{:016x}", journey.engine.hash().value());
  json["events"] = journey.events.size();
  json["ending"] = outcome.ending;
  json["problems"] = outcome.problems;
  RAVE_TRY(write_file_atomically(folder / "events.log",
                                 events_log(journey.engine, kinds, journey.events)));
  return write_file_atomically(folder / "result.json", json.dump(2) + "\n");
}

HostOutcome judge(const Journey& journey) {
  HostOutcome outcome;
  outcome.steps = journey.engine.steps_done();
  outcome.problems = journey.problems;
  if (journey.stopped) outcome.problems.emplace_back("stopped before the run was over");
  if (journey.ended) {
    outcome.ending = journey.port.ending().text;
    if (!journey.port.ending().good) outcome.problems.push_back("the run ended: " + outcome.ending);
  }
  outcome.whole = outcome.problems.empty();
  return outcome;
}

}  // namespace

std::uint64_t shared_number(const config::ExpandedScenario& scenario) {
  const config::ScenarioFile usual;
  config::ExpandedScenario shared = scenario;
  shared.scenario.pace = usual.pace;
  shared.scenario.threads = usual.threads;
  shared.scenario.description.clear();
  shared.scenario.on_lost_host = usual.on_lost_host;
  shared.scenario.host_timeout_s = usual.host_timeout_s;
  return lock_step::scenario_number(config::write_expanded(shared));
}

Status check_can_be_shared(const BuiltScenario& built) {
  if (built.spec.obstacle_changes.empty()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "the scenario changes obstacles while it runs, which hosts in lock-step cannot yet; "
              "run it in one process");
}

std::uint64_t interface_stamp() {
  return mix64(robot_interface_hash() ^ mix64(virtual_interface_hash()));
}

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
  RAVE_TRY_ASSIGN(BuiltScenario built, build(scenario, catalogue, how));
  options.others.reset();
  if (!built.live_reason.empty()) {
    return run_live_host({scenario, expanded, catalogue, options, seat, console, pace},
                         std::move(built));
  }
  built.spec.live_clock = nullptr;
  RAVE_TRY(check_can_be_shared(built));
  for (const std::string& note : built.notes) console.warn("scenario", "{}", note);
  lock_step::Identity self{seat.number, options.host,
                           static_cast<std::uint32_t>(seat.robots.size()), shared_number(scenario),
                           interface_stamp()};
  self.real_robots = real_robots(built.spec, seat.robots);
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  RAVE_TRY_ASSIGN(const auto port, HostPort::open(options.bus, std::move(self), &console));
  const BodyKinds kinds(engine->spec(), built.robot_kinds);
  std::unique_ptr<RecordKeeper> record;
  if (run.record) {
    RAVE_TRY_ASSIGN(record, RecordKeeper::begin(run.output / "run.mcap", *engine, kinds,
                                                {scenario.scenario.name.value, expanded,
                                                 versions_of(engine->spec(), catalogue),
                                                 input_files(scenario, *engine), true},
                                                run.log));
  }
  const RecordedConsole recorded(console, record ? &record->recorder() : nullptr);
  Journey journey({*engine, record.get(), options, console}, *port);
  journey.report.host = seat.number;
  const ControlledHost controlled(*engine, scenario.scenario, run.control, false);
  tell_who_waits(*engine, run, console);
  const Status went = go_through(journey);
  engine->halt();
  console.attach(nullptr);
  HostOutcome outcome = judge(journey);
  if (record) {
    const Status written = record->end(engine->hash().value());
    if (!written) outcome.problems.push_back("the record is not whole: " + written.error().text());
  }
  outcome.whole = outcome.whole && outcome.problems.empty();
  RAVE_TRY(write_results(journey, kinds, outcome));
  if (!went) return tl::unexpected(went.error());
  return outcome;
}

}  // namespace rave::robot_host
