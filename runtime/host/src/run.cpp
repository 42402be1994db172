// SPDX-License-Identifier: Apache-2.0
#include "rave/host/run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "rave/base/file.hpp"
#include "rave/control/requests.hpp"
#include "rave/host/observer_list.hpp"
#include "rave/observe/event_words.hpp"
#include "rave/pace/late_watch.hpp"
#include "rave/pace/stall_watch.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/outcome.hpp"
#include "waiting_robots.hpp"

namespace rave::runtime {
namespace {

using Clock = std::chrono::steady_clock;

/// How old what others see of hand-overs and shadows may be.
constexpr auto kStatusInterval = std::chrono::milliseconds(50);
/// So many times as old while steps come late.
constexpr int kLateFactor = 10;

/// A run on its way: what the loop needs, and what it leaves.
struct Journey {
  sim::Engine& engine;
  ObserverList& observers;
  WallPace& pace;
  LateWatch& late;
  bool live = false;
  const config::ScenarioFile& file;
  const RunOptions& options;
  ConsoleTee& console;
  std::vector<sim::Event> events{};
  double wall_s = 0;
  bool stopped = false;
  bool shows_more = false;  ///< Its status changes though nobody asks for anything.
  Clock::time_point next_progress{};
  Clock::time_point next_status{};
};

void refresh(const Journey& journey, RunStatus& status) {
  refresh_status(journey.engine, status);
  journey.observers.refresh(status);
  if (const Shadows* const shadows = journey.observers.shadows()) shadows->refresh(status);
}

/// Does what somebody has asked for since the last step.
void serve_requests(Journey& journey) {
  if (journey.options.control == nullptr) return;
  journey.observers.tick(journey.engine);
  journey.options.control->serve(
      [&journey](const RunRequest& request) {
        return journey.observers.serve(journey.engine, request);
      },
      [&journey](RunStatus& status) { refresh(journey, status); });
}

/// Waits until the next step may be done; false: the run is to end.
bool wait_for_turn(Journey& journey) {
  RunControl* const control = journey.options.control;
  const auto serve = [&journey] { serve_requests(journey); };
  if (control != nullptr) {
    const auto asked = Clock::now();
    // The world outside a live run goes on, so that is not held.
    const bool held = !journey.live && control->paused();
    const auto show = [&journey] { journey.observers.held(journey.engine); };
    if (held ? !control->wait_for_turn(serve, show) : control->stopping()) return false;
    if (held) journey.pace.shift(Clock::now() - asked);
  }
  const auto steps = static_cast<std::int64_t>(journey.engine.steps_done());
  if (const auto factor =
          control == nullptr || journey.live ? std::nullopt : control->take_pace()) {
    journey.pace.change_factor(*factor, SimTime{steps * journey.engine.spec().step.ns});
  }
  const SimTime due{steps * journey.engine.spec().step.ns};
  journey.pace.wait_for(due, control, serve);
  Lateness& count = journey.late.count();
  count.woke(journey.pace.wall_time_of(due), Clock::now());
  serve();
  count.did(Lateness::Part::kRequests, Clock::now());
  return true;
}

void tell_progress(const Journey& journey) {
  const double sim_s = static_cast<double>(journey.engine.steps_done()) * journey.file.step_s.value;
  journey.options.on_progress({sim_s / journey.file.duration_s, sim_s, journey.file.duration_s,
                               journey.wall_s > 0 ? sim_s / journey.wall_s : 0,
                               journey.engine.spec().robots.size(),
                               journey.observers.results().encounters.headline()});
}

/// A step is done. False: a check ends the run with it.
bool look_back(Journey& journey) {
  sim::Engine& engine = journey.engine;
  Lateness& count = journey.late.count();
  count.worked(engine.phase_times(), Clock::now());
  if (journey.options.control != nullptr) {
    journey.options.control->set_time(engine.time().seconds());
  }
  const StepView step(engine, {}, journey.live && journey.late.behind());
  journey.observers.after_step(step);
  count.did(Lateness::Part::kOnlookers, Clock::now());
  journey.observers.keep(step);
  count.did(Lateness::Part::kRecord, Clock::now());
  if (journey.live) journey.late.look(engine.spec(), engine.events(), {});
  tell_events(engine, engine.events(), &journey.console, journey.events);
  journey.observers.tell_found(engine, &journey.console, journey.events);
  const auto& capture = journey.observers.results().capture;
  return !capture || !capture->ends_run();
}

/// What others see of the run between two requests.
void tell_onlookers(Journey& journey, Clock::time_point now) {
  RunControl* const control = journey.options.control;
  const int rarer = journey.late.behind() ? kLateFactor : 1;
  const bool shows_more = journey.shows_more || journey.observers.has_orders();
  if (control != nullptr && shows_more && now >= journey.next_status) {
    journey.next_status = now + rarer * kStatusInterval;
    control->refresh([&](RunStatus& status) { refresh(journey, status); });
  }
  if (journey.options.on_progress && now >= journey.next_progress) {
    journey.next_progress = now + kProgressInterval;
    tell_progress(journey);
  }
}

Status go_through(Journey& journey) {
  const auto steps =
      static_cast<std::uint64_t>(std::llround(journey.file.duration_s / journey.file.step_s.value));
  StallWatch watch(&journey.console);
  const auto begin = Clock::now();
  const auto& robots = journey.engine.spec().robots;
  journey.shows_more = std::any_of(robots.begin(), robots.end(),
                                   [](const auto& robot) { return robot.twin.has_value(); });
  bool goes_on = true;
  while (goes_on && journey.engine.steps_done() < steps) {
    if (!wait_for_turn(journey)) {
      journey.stopped = true;
      break;
    }
    watch.step_begins(journey.engine.steps_done());
    // The world of a step that comes late is one of before: no guard may take it for the present.
    if (journey.live) journey.engine.set_world_age(journey.late.age());
    RAVE_TRY(journey.engine.step());
    watch.step_ends();
    goes_on = look_back(journey);
    const auto now = Clock::now();
    journey.wall_s = std::chrono::duration<double>(now - begin).count();
    tell_onlookers(journey, now);
    journey.late.step_done();
  }
  const auto last = static_cast<std::int64_t>(steps - 1) * journey.engine.spec().step.ns;
  journey.late.end(journey.pace.wall_time_of(SimTime{last}));
  return {};
}

/// Hand-overs that the end of the run has cut off, as events of the step that does not come any
/// more. No part of the hash.
std::vector<sim::Event> unfinished_hand_overs(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  const auto word = [&spec](std::uint32_t type) {
    return spec.types[type].simulated ? "simulated" : "real";
  };
  std::vector<sim::Event> events;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const auto state = engine.hand_over_state(RobotId(r));
    if (!state || !state->under_way) continue;
    const sim::RobotSpec& robot = spec.robots[r];
    events.push_back(
        {engine.steps_done(), RobotId(r), sim::EventKind::kHandOverRefused, BodyId(),
         fmt::format("{} -> {}: the run ended before the hand-over{}", word(robot.type),
                     word(robot.twin.value_or(robot.type)), state->by_hand ? " (by hand)" : "")});
  }
  return events;
}

/// Lets others control a run as long as it goes.
class Controlled {
 public:
  explicit Controlled(const Journey& journey) : control_(journey.options.control) {
    if (control_ == nullptr) return;
    RunStatus status;
    status.scenario = journey.file.name.value;
    status.duration_s = journey.file.duration_s;
    status.pace = journey.live ? 1 : journey.file.pace.factor;
    status.live = journey.live;
    refresh_status(journey.engine, status);
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

}  // namespace

Result<RunOutcome> run(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                       const RunOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) {
    return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}", options.output.string(),
                error.message());
  }
  const std::string expanded = config::write_expanded(scenario);
  RAVE_TRY(write_file_atomically(options.output / "scenario.yaml", expanded));

  config::ExpandedScenario adjusted = scenario;
  config::ScenarioFile& file = adjusted.scenario;
  keep_history_for_observers(file);

  // Outlives the engine, whose drivers and programs speak to it.
  ConsoleTee console(options.log);
  WallPace pace(file.pace.factor);
  RAVE_TRY_ASSIGN(BuiltScenario built,
                  build(adjusted, catalogue, {options.program_runner, &console, &pace}));
  const bool live = !built.live_reason.empty();
  if (live && (file.pace.is_max() || file.pace.factor > 1)) {
    console.warn("run", "the run is in real time: {}", built.live_reason);
    pace.set_factor(1);
  }
  if (!live) built.spec.live_clock = nullptr;
  if (live) built.spec.on_ready = [&pace] { pace.start(); };
  const auto period = pace.period_of(built.spec.step);
  if (period > Clock::duration::zero()) built.spec.phase_clock = steady_ns;
  for (const std::string& note : built.notes) {
    console.warn("scenario", "{}", note);
  }
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));

  RAVE_TRY_ASSIGN(const auto observers,
                  ObserverList::open({adjusted, expanded, built.robot_kinds, *engine, catalogue,
                                      options, console, "", live, true}));
  LateWatch late(period, console, options.control);
  Journey journey{*engine, *observers, pace, late, live, file, options, console};
  if (!live) pace.start();  // a live run counts from when its sensors were opened
  const Controlled controlled(journey);
  tell_who_waits(*engine, options, console);
  RAVE_TRY(go_through(journey));
  tell_events(*engine, unfinished_hand_overs(*engine), &console, journey.events);
  // Writing the results takes a while; nobody drives on meanwhile.
  engine->halt();
  if (options.control != nullptr) options.control->end();
  const std::string record_problem =
      observers->end_record(live ? std::nullopt : std::optional(engine->hash().value()));
  RunFacts facts = gather(observers->results(), *engine);
  facts.events = std::move(journey.events);
  facts.lateness = late.facts();
  if (live) facts.problems = lateness_problems(late.facts(), file.max_missed_pct);
  if (observers->shadows() != nullptr) facts.shadows = observers->shadows()->facts();
  if (!record_problem.empty()) facts.problems.push_back(record_problem);
  Findings findings{adjusted, engine->spec(), observers->results().kinds, built.live_reason, facts};
  findings.wall_s = journey.wall_s;
  findings.ended_early = journey.stopped;
  if (!live) findings.hash = engine->hash().value();
  return write_results(findings, options.output, options.picture);
}

}  // namespace rave::runtime
