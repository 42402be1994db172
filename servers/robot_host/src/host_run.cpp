// SPDX-License-Identifier: Apache-2.0
#include "rave/robot_host/host_run.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "console_tee.hpp"
#include "event_log.hpp"
#include "rave/base/file.hpp"
#include "rave/base/names.hpp"
#include "rave/lock_step/host_port.hpp"
#include "rave/robot/interface_hash.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/provenance.hpp"
#include "record_keeper.hpp"
#include "requests.hpp"

namespace rave::robot_host {
namespace {

using lock_step::HostPort;

/// The number and the robots of a host that is named.
struct Seat {
  std::uint32_t number = 0;
  std::vector<RobotId> robots;
};

Result<Seat> find_seat(const config::ExpandedScenario& scenario, const std::string& name) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::vector<std::string_view> names;
  for (std::uint32_t h = 0; h < hosts.size(); ++h) {
    names.emplace_back(hosts[h].name);
    if (hosts[h].name != name) continue;
    Seat seat{h, {}};
    for (const std::size_t robot : hosts[h].robots) {
      seat.robots.emplace_back(static_cast<std::uint32_t>(robot));
    }
    return seat;
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

/// A host on its way through a run.
struct Journey {
  sim::Engine& engine;
  HostPort& port;
  RecordKeeper* record;
  const HostOptions& options;
  ConsoleTee& console;
  std::vector<sim::Event> events;
  sim::HostReport report;
  sim::WorldStep world;
  std::vector<std::string> problems;
  bool stopped = false;
  bool ended = false;  ///< By the manager.
};

void serve_requests(Journey& journey) {
  RunControl* const control = journey.options.run.control;
  if (control == nullptr) return;
  control->serve(
      [&journey](const RunRequest& request) {
        auto answer = serve_request(journey.engine, request);
        if (answer && journey.record != nullptr) journey.record->keep(request, journey.engine);
        return answer;
      },
      [&journey](RunStatus& status) { refresh_status(journey.engine, status); });
}

/// A step is done: the report of the next one is there.
void look_back(Journey& journey) {
  sim::Engine& engine = journey.engine;
  if (engine.steps_done() == 0) return;
  RunControl* const control = journey.options.run.control;
  if (control != nullptr) control->set_time(engine.time().seconds());
  if (journey.record != nullptr) journey.record->after_step(engine);
  tell_events(engine, engine.events(), &journey.console, journey.events);
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kProgramFailed &&
        event.kind != sim::EventKind::kDriverFailed) {
      continue;
    }
    journey.problems.push_back(fmt::format(
        "robot `{}`: {} at {:.2f} s: {}", engine.spec().robots[event.robot.value()].name,
        to_string(event.kind), engine.time().seconds(), event.text));
  }
}

Status propose(Journey& journey) {
  const Status status = journey.engine.propose(journey.report);
  // The others shall know why.
  if (!status) journey.port.farewell(journey.report, journey.engine.hash().value());
  return status;
}

/// Takes the next step of the world in; false: there is none for this host.
Result<bool> take_step(Journey& journey) {
  RunControl* const control = journey.options.run.control;
  const auto stopping = [control] { return control != nullptr && control->stopping(); };
  if (stopping()) {
    journey.stopped = true;
    return false;
  }
  RAVE_TRY_ASSIGN(
      const HostPort::Answer answer,
      journey.port.exchange(journey.report, journey.engine.hash().value(), journey.world, [&] {
        serve_requests(journey);
        return stopping();
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
  RAVE_TRY(journey.engine.join(journey.world));
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

class Controlled {
 public:
  Controlled(const sim::Engine& engine, const config::ScenarioFile& file, RunControl* control)
      : control_(control) {
    if (control_ == nullptr) return;
    RunStatus status;
    status.scenario = file.name.value;
    status.duration_s = file.duration_s;
    status.pace = file.pace.factor;
    refresh_status(engine, status);
    control_->begin(std::move(status));
  }
  Controlled(const Controlled&) = delete;
  Controlled& operator=(const Controlled&) = delete;
  ~Controlled() {
    if (control_ != nullptr) control_->end();
  }

 private:
  RunControl* control_;
};

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
  if (!built.live_reason.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "hosts share a world in lock-step, which nothing by the wall clock can: {}",
                built.live_reason);
  }
  if (!built.spec.obstacle_changes.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "the scenario changes obstacles while it runs, which hosts that share a world "
                "cannot yet; run it in one process");
  }
  return {};
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
  RAVE_TRY_ASSIGN(BuiltScenario built, build(scenario, catalogue, how));
  options.others.reset();
  RAVE_TRY(check_can_be_shared(built));
  for (const std::string& note : built.notes) console.warn("scenario", "{}", note);
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  RAVE_TRY_ASSIGN(const auto port, HostPort::open(options.bus,
                                                  {seat.number, options.host,
                                                   static_cast<std::uint32_t>(seat.robots.size()),
                                                   shared_number(scenario), interface_stamp()},
                                                  &console));
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
  Journey journey{*engine, *port, record.get(), options, console, {}, {}, {}, {}};
  journey.report.host = seat.number;
  const Controlled controlled(*engine, scenario.scenario, run.control);
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
