// SPDX-License-Identifier: Apache-2.0
#include "rave/host/host_journey.hpp"

#include <algorithm>
#include <cmath>

#include "rave/assemble/parameter_key.hpp"
#include "rave/base/file.hpp"
#include "rave/base/names.hpp"
#include "rave/control/requests.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/facts_file.hpp"

namespace rave::runtime {
namespace {

void warn(LogSink& log, const Status& told) {
  if (!told) log.warn("roster", "{}", told.error().message);
}

/// Whoever looks on is told what a robot has become.
void keep_roster(HostJourney& journey, std::span<const sim::ResizedRobot> resized) {
  const sim::Engine& engine = journey.engine;
  const auto note = [&](RobotId robot) {
    if (robot.valid() && engine.is_local(robot)) journey.roster.note(robot);
  };
  for (const sim::Event& event : engine.events()) {
    if (event.kind == sim::EventKind::kHandedOver || event.kind == sim::EventKind::kChanged) {
      note(event.robot);
    }
  }
  for (const sim::ResizedRobot& robot : resized) note(robot.robot);
  if (!journey.roster.due()) return;
  warn(journey.console, journey.roster.tell(engine.spec(), [&](RobotId robot) {
    return present_values(engine, robot);
  }));
}

/// Whether something has changed that people are told of each robot, whoever asked for it and
/// where.
bool changes_status(std::span<const sim::Event> events) {
  return std::ranges::any_of(events, [](const sim::Event& event) {
    using enum sim::EventKind;
    return event.kind == kStopped || event.kind == kReleased || event.kind == kArmed ||
           event.kind == kHandedOver || event.kind == kOrdered || event.kind == kSaid;
  });
}

}  // namespace

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

std::uint32_t real_robots(const sim::EngineSpec& spec, std::span<const RobotId> robots) {
  return static_cast<std::uint32_t>(std::ranges::count_if(robots, [&](RobotId robot) {
    return !spec.types[spec.robots[robot.value()].type].simulated;
  }));
}

std::uint64_t steps_of(const config::ScenarioFile& scenario) {
  return static_cast<std::uint64_t>(std::llround(scenario.duration_s / scenario.step_s.value));
}

void introduce_robots(lock_step::Roster& roster, const sim::EngineSpec& spec,
                      std::span<const RobotId> robots, LogSink& log) {
  roster.note(robots);
  warn(log, roster.tell(spec, [&](RobotId robot) {
    return first_values(spec.types[spec.robots[robot.value()].type]);
  }));
}

void serve_requests(HostJourney& journey) {
  RunControl* const control = journey.options.run.control;
  if (control == nullptr) return;
  journey.observers.tick(journey.engine);
  control->serve(
      [&journey](const RunRequest& request) {
        return journey.observers.serve(journey.engine, request);
      },
      [&journey](RunStatus& status) { refresh(journey, status); });
}

void refresh(const HostJourney& journey, RunStatus& status) {
  refresh_status(journey.engine, status);
  journey.observers.refresh(status);
  if (const Shadows* const shadows = journey.observers.shadows()) shadows->refresh(status);
}

void look_back(HostJourney& journey, std::span<const sim::Event> beside,
               std::span<const sim::ResizedRobot> resized, bool late) {
  sim::Engine& engine = journey.engine;
  RunControl* const control = journey.options.run.control;
  if (control != nullptr) control->set_time(engine.time().seconds());
  if (control != nullptr && changes_status(engine.events())) {
    control->refresh([&journey](RunStatus& status) { refresh(journey, status); });
  }
  const StepView step(engine, beside, late);
  journey.observers.after_step(step);
  journey.observers.keep(step);
  tell_events(engine, engine.events(), &journey.console, journey.events);
  tell_events(engine, beside, &journey.console, journey.events);
  journey.observers.tell_found(engine, &journey.console, journey.events);
  keep_roster(journey, resized);
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kProgramFailed &&
        event.kind != sim::EventKind::kDriverFailed) {
      continue;
    }
    journey.losses.push_back(fmt::format(
        "robot `{}`: {} at {:.2f} s: {}", engine.spec().robots[event.robot.value()].name,
        to_string(event.kind), engine.time().seconds(), event.text));
  }
}

void note_end(const HostJourney& journey, std::string_view ending, bool good,
              HostOutcome& outcome) {
  outcome.problems = journey.losses;
  outcome.problems.insert(outcome.problems.end(), journey.problems.begin(), journey.problems.end());
  if (journey.stopped) outcome.problems.emplace_back("stopped before the end of the run");
  if (journey.ended) {
    outcome.ending = ending;
    if (!good) outcome.problems.push_back("the run ended: " + outcome.ending);
  }
  outcome.whole = outcome.problems.empty();
}

std::vector<std::byte> encode_facts(const HostJourney& journey, RunFacts facts) {
  const HostOptions& options = journey.options;
  facts.events = journey.events;
  if (journey.world_tells) {
    std::erase_if(facts.events, [](const sim::Event& event) { return !event.robot.valid(); });
  }
  for (std::string& problem : facts.problems) {
    problem = fmt::format("host `{}`: {}", options.host, problem);
  }
  return encode_facts(FactsOf{journey.run_number, options.host}, facts);
}

Status leave_facts(const HostJourney& journey, std::span<const std::byte> bytes,
                   const std::function<Status(std::span<const std::byte>)>& deliver) {
  // First of all where a process that dies now has them.
  Status written =
      write_file_atomically(journey.options.run.output / kFactsFile,
                            {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (const Status sent = deliver(bytes); !sent) {
    journey.console.warn("host", "the environment manager did not receive its results: {}",
                         sent.error().message);
  }
  return written;
}

std::vector<sim::Event> obstacle_events(const sim::WorldStep& world) {
  std::vector<sim::Event> events;
  for (const sim::ObstacleChange& change : world.obstacles) {
    events.push_back(
        sim::obstacle_event(world.step, change, "", {!change.asked.empty(), change.by}));
  }
  return events;
}

ControlledHost::ControlledHost(const sim::Engine& engine, const config::ScenarioFile& file,
                               RunControl* control, bool live)
    : control_(control) {
  if (control_ == nullptr) return;
  RunStatus status;
  status.scenario = file.name.value;
  status.duration_s = file.duration_s;
  status.pace = live ? 1 : file.pace.factor;
  status.live = live;
  status.follows = !live;
  refresh_status(engine, status);
  control_->begin(std::move(status));
}

ControlledHost::~ControlledHost() {
  if (control_ != nullptr) control_->end();
}

}  // namespace rave::runtime
