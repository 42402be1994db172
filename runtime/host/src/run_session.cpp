// SPDX-License-Identifier: Apache-2.0
#include "run_session.hpp"

#include <algorithm>
#include <cmath>

#include "rave/control/requests.hpp"
#include "rave/results/event_log.hpp"

namespace rave::runtime {
namespace {

using Clock = RunSession::Clock;

/// How old what others see of hand-overs, shadows and orders may be.
constexpr auto kStatusInterval = std::chrono::milliseconds(50);
/// The factor on that age while steps come late.
constexpr int kLateFactor = 10;

bool any_twin(const sim::Engine& engine) {
  const auto& robots = engine.spec().robots;
  for (std::uint32_t r = 0; r < robots.size(); ++r) {
    if (robots[r].twin && engine.is_local(RobotId(r))) return true;
  }
  return false;
}

/// Whether it has a robot whose hardware can fall silent, and come back.
bool any_real(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (engine.is_local(RobotId(r)) && !spec.types[spec.robots[r].type].simulated) return true;
  }
  return false;
}

/// Brings up to date what others see of the run.
void refresh(const RunSession& run, RunStatus& status) {
  refresh_status(run.engine, status);
  run.observers.refresh(status);
  if (const Shadows* const shadows = run.observers.shadows()) shadows->refresh(status);
}

/// Whether something has changed that people see of each robot, whatever caused it and
/// where.
bool changes_status(std::span<const sim::Event> events) {
  return std::ranges::any_of(events, [](const sim::Event& event) {
    using enum sim::EventKind;
    return event.kind == kStopped || event.kind == kReleased || event.kind == kArmed ||
           event.kind == kDisarmed || event.kind == kHandedOver || event.kind == kOrdered ||
           event.kind == kSaid || event.kind == kProgramFailed || event.kind == kDriverFailed ||
           event.kind == kDriverBack;
  });
}

void note_losses(RunSession& run) {
  const sim::Engine& engine = run.engine;
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kProgramFailed &&
        event.kind != sim::EventKind::kDriverFailed) {
      continue;
    }
    run.losses.push_back(fmt::format("robot `{}`: {} at {:.2f} s: {}",
                                     engine.spec().robots[event.robot.value()].name,
                                     to_string(event.kind), engine.time().seconds(), event.text));
  }
}

void tell_progress(const RunSession& run) {
  const double sim_s = static_cast<double>(run.engine.steps_done()) * run.file.step_s.value;
  const config::RunLength length = run.file.duration_s;
  run.options.on_progress({sim_s / length, sim_s, length.known_end_s(),
                           run.wall_s > 0 ? sim_s / run.wall_s : 0, run.engine.spec().robots.size(),
                           run.observers.results().encounters.headline()});
}

/// What others see of the run between two requests.
void tell_status(RunSession& run, Clock::time_point now) {
  RunControl* const control = run.options.control;
  const bool changes = run.has_real || run.has_twins || run.observers.has_orders();
  if (control != nullptr && changes && now >= run.next_status) {
    run.next_status = now + (run.late.behind() ? kLateFactor : 1) * kStatusInterval;
    control->refresh([&run](RunStatus& status) { refresh(run, status); });
  }
  if (run.options.on_progress && now >= run.next_progress) {
    run.next_progress = now + kProgressInterval;
    tell_progress(run);
  }
}

/// Arms robots if that was asked for, else says who waits for it.
void tell_who_waits(const RunSession& run) {
  const std::string names = unarmed_robots(run.engine);
  if (names.empty()) return;
  if (run.options.arm) {
    run.engine.arm(RobotId(), sim::Author::kRun);
    run.console.warn("run", "armed from the start: {}", names);
    return;
  }
  const std::string& name = run.options.run_name;
  run.console.warn("run", "{} will stand until armed: `rave arm{}{}` in another terminal", names,
                   name.empty() ? "" : " ", name);
}

}  // namespace

std::uint64_t steps_of(const config::ScenarioFile& scenario) {
  return static_cast<std::uint64_t>(std::llround(scenario.duration_s / scenario.step_s.value));
}

RunSession::RunSession(sim::Engine& of, ObserverList& all, WallPace& clock,
                       const config::ScenarioFile& run, const RunOptions& how, ConsoleTee& log,
                       bool in_real_time)
    : engine(of),
      observers(all),
      pace(clock),
      file(run),
      options(how),
      console(log),
      live(in_real_time),
      steps(steps_of(run)),
      has_real(any_real(of)),
      has_twins(any_twin(of)),
      late(clock.period_of(of.spec().step), log, how.control),
      watch(&log) {
  if (how.control == nullptr) return;
  RunStatus status;
  status.scenario = run.name.value;
  status.run = how.run_id;
  status.duration_s = run.duration_s.known_s();
  status.pace = live ? 1 : run.pace.factor;
  status.live = live;
  // Several hosts in lock-step go as their manager says.
  status.follows = !live && of.spec().local;
  refresh_status(of, status);
  how.control->begin(std::move(status));
}

Status go_through(RunSession& run, WorldExchange& exchange) {
  tell_who_waits(run);
  const auto began = Clock::now();
  RAVE_TRY_ASSIGN(bool goes_on, exchange.begin());
  while (goes_on) {
    RAVE_TRY_ASSIGN(goes_on, exchange.await_turn());
    if (!goes_on) break;
    run.watch.step_begins(run.step);
    const Status done = exchange.step();
    run.watch.step_ends();
    RAVE_TRY(done);
    const auto now = Clock::now();
    run.wall_s = std::chrono::duration<double>(now - began).count();
    tell_status(run, now);
    run.late.step_done();
  }
  const auto last = static_cast<std::int64_t>(run.steps - 1) * run.engine.spec().step.ns;
  run.late.end(run.pace.wall_time_of(SimTime{last}));
  return {};
}

void serve_requests(RunSession& run) {
  if (run.options.control == nullptr) return;
  run.observers.tick(run.engine);
  const auto serve = [&run](RunControl::Asked& asked) -> std::optional<Result<std::string>> {
    auto answer = run.observers.serve(run.engine, asked.request());
    const auto given = run.observers.take_given();
    if (!answer || !given || run.forwarder == nullptr) return answer;
    run.forwarder->await(*given, std::move(asked), *std::move(answer));
    return std::nullopt;
  };
  run.options.control->serve_or_keep(serve, [&run](RunStatus& status) { refresh(run, status); });
}

void look_on_while_held(RunSession& run) {
  run.observers.held(run.engine);
  run.observers.tick(run.engine);
  const auto now = Clock::now();
  if (run.options.control == nullptr || now < run.next_status) return;
  run.next_status = now + kStatusInterval;
  run.options.control->refresh([&run](RunStatus& status) { refresh(run, status); });
}

void look_back(RunSession& run, std::span<const sim::Event> beside, Duration world_age) {
  // Who looks on is neither a driver nor a program.
  run.watch.step_ends();
  sim::Engine& engine = run.engine;
  Lateness& count = run.late.count();
  count.worked(engine.phase_times(), Clock::now());
  RunControl* const control = run.options.control;
  if (control != nullptr) control->set_time(engine.time().seconds());
  if (control != nullptr && changes_status(engine.events())) {
    control->refresh([&run](RunStatus& status) { refresh(run, status); });
  }
  const StepView step(engine, beside, run.live && run.late.behind());
  run.observers.after_step(step);
  count.did(Lateness::Part::kOnlookers, Clock::now());
  run.observers.after_all(step);
  count.did(Lateness::Part::kRecord, Clock::now());
  if (run.live) run.late.look(engine.spec(), engine.events(), world_age);
  tell_events(engine, engine.events(), &run.console, run.events);
  tell_events(engine, beside, &run.console, run.events);
  run.observers.tell_found(engine, &run.console, run.events);
  note_losses(run);
  count.did(Lateness::Part::kOnlookers, Clock::now());
}

RunFacts end_run(RunSession& run) {
  // Writing the results takes a while; robots must not keep driving meanwhile.
  run.engine.halt();
  const auto hash = run.live ? std::nullopt : std::optional(run.engine.hash().value());
  const std::string record_problem = run.observers.end_record(hash);
  if (run.live) {
    for (std::string& late : lateness_problems(run.late.facts(), run.file.max_missed_pct)) {
      run.problems.push_back(std::move(late));
    }
  }
  if (!record_problem.empty()) run.problems.push_back(record_problem);
  if (const auto& conductor = run.engine.spec().conductor; conductor) {
    if (auto failure = conductor->failure()) run.problems.push_back(*std::move(failure));
  }
  RunFacts facts = gather(run.observers.results(), run.engine);
  facts.first_step = run.first;
  facts.events = run.events;
  facts.problems = run.problems;
  facts.lateness = run.late.facts();
  if (run.observers.shadows() != nullptr) facts.shadows = run.observers.shadows()->facts();
  return facts;
}

}  // namespace rave::runtime
