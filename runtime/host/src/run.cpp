// SPDX-License-Identifier: Apache-2.0
#include "rave/host/run.hpp"

#include "rave/base/file.hpp"
#include "rave/observe/event_words.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/outcome.hpp"
#include "run_session.hpp"

namespace rave::runtime {
namespace {

/// All robots run in this process: its engine has the world.
class LoneExchange final : public WorldExchange {
 public:
  explicit LoneExchange(RunSession& run) : run_(run) {}

  Result<bool> await_turn() override {
    const auto& capture = run_.observers.results().capture;
    run_.step = run_.engine.steps_done();
    const auto& conductor = run_.engine.spec().conductor;
    if (run_.step >= run_.steps || (capture && capture->ends_run()) ||
        (conductor && conductor->ended())) {
      return false;
    }
    run_.stopped = !wait();
    return !run_.stopped;
  }
  Status step() override {
    // The world of a step that comes late is one of before: no guard may take it for the present.
    if (run_.live) run_.engine.set_world_age(run_.late.age());
    RAVE_TRY(run_.engine.step());
    look_back(run_);
    return {};
  }

 private:
  bool wait();

  RunSession& run_;
};

/// Until the next step is due; false: the run is to end.
bool LoneExchange::wait() {
  RunControl* const control = run_.options.control;
  const auto serve = [this] { serve_requests(run_); };
  const SimTime due{static_cast<std::int64_t>(run_.step) * run_.engine.spec().step.ns};
  if (control != nullptr) {
    const auto asked = RunSession::Clock::now();
    // The world outside a live run continues, so such a run is not held.
    const bool held = !run_.live && control->paused();
    const auto show = [this] { look_on_while_held(run_); };
    if (held ? !control->wait_for_turn(serve, show) : control->stopping()) return false;
    if (held) run_.pace.shift(RunSession::Clock::now() - asked);
    const auto factor = run_.live ? std::nullopt : control->take_pace();
    if (factor) run_.pace.change_factor(*factor, due);
  }
  run_.pace.wait_for(due, control, serve);
  Lateness& count = run_.late.count();
  count.woke(run_.pace.wall_time_of(due), RunSession::Clock::now());
  serve();
  count.did(Lateness::Part::kRequests, RunSession::Clock::now());
  return true;
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

}  // namespace

Result<RunOutcome> run(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                       const RunOptions& options) {
  RAVE_TRY(create_folder(options.output));
  const std::string expanded = config::write_expanded(scenario);
  RAVE_TRY(write_private_file_atomically(options.output / "scenario.yaml", expanded));

  config::ExpandedScenario adjusted = scenario;
  config::ScenarioFile& file = adjusted.scenario;
  keep_history_for_observers(file);

  // Outlives the engine, whose drivers and programs speak to it.
  ConsoleTee console(options.log);
  WallPace pace(file.pace.factor);
  RAVE_TRY_ASSIGN(BuiltScenario built,
                  build(adjusted, catalogue, {options.program_runner, &console, &pace}));
  const bool live = !built.live_reason.empty();
  if (options.control != nullptr) RAVE_TRY(options.control->check_start(built.live_reason));
  if (live && (file.pace.is_max() || file.pace.factor > 1)) {
    console.warn("run", "the run is in real time: {}", built.live_reason);
    pace.set_factor(1);
  }
  if (!live) built.spec.live_clock = nullptr;
  if (live) built.spec.on_ready = [&pace] { pace.start(); };
  if (pace.period_of(built.spec.step).count() > 0) built.spec.phase_clock = steady_ns;
  for (const std::string& note : built.notes) {
    console.warn("scenario", "{}", note);
  }
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));

  Descriptor room = take_room_for_results(options.output, engine->spec());
  RAVE_TRY_ASSIGN(const auto observers,
                  ObserverList::open({adjusted, expanded, built.robot_kinds, *engine, catalogue,
                                      options, console, "", live, true}));
  RunSession session(*engine, *observers, pace, file, options, console, live);
  if (!live) pace.start();  // a live run counts from when its sensors were opened
  LoneExchange exchange(session);
  RAVE_TRY(go_through(session, exchange));
  tell_events(*engine, unfinished_hand_overs(*engine), &console, session.events);
  if (options.control != nullptr) options.control->end();
  RunFacts facts = end_run(session);
  RunResults results{adjusted, engine->spec(), observers->results().kinds, built.live_reason,
                     facts};
  results.wall_s = session.wall_s;
  results.ended_by_hand = session.stopped;
  if (!live) results.hash = engine->hash().value();
  room.reset();
  return write_results(results, options.output, options.picture);
}

}  // namespace rave::runtime
