// SPDX-License-Identifier: Apache-2.0
#include "rave/robot_host/run.hpp"

#include <chrono>
#include <thread>

#include "outcome.hpp"
#include "rave/base/file.hpp"
#include "stall_watch.hpp"
#include "wall_pace.hpp"

namespace rave::robot_host {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(100);

/// All observers of one run.
struct Observers {
  BodyKinds kinds;
  TrackRecorder tracks;
  Encounters encounters;
  HitCounter hits;
  std::optional<SightingCheck> sightings;
  std::optional<InstantKeeper> instant;

  Observers(const config::ScenarioFile& scenario, const BuiltScenario& built,
            const sim::EngineSpec& spec)
      : kinds(spec, built.robot_kinds),
        tracks(kinds, spec, scenario.duration_s,
               scenario.picture && scenario.picture->odometry_sensor
                   ? scenario.picture->odometry_sensor->value
                   : std::string()),
        encounters(kinds, spec),
        hits(kinds) {
    if (scenario.checks.sightings) sightings.emplace(*scenario.checks.sightings, spec);
    if (scenario.picture) {
      instant.emplace(kinds, scenario.picture->instant_s.value_or(scenario.duration_s / 2));
    }
  }

  void after_step(sim::Engine& engine) {
    tracks.after_step(engine);
    encounters.after_step(engine);
    hits.after_step(engine);
    if (sightings) sightings->after_step(engine);
    if (instant) instant->after_step(engine);
  }
};

void tell_events(const sim::Engine& engine, LogSink* log, std::vector<sim::Event>& all) {
  const sim::EngineSpec& spec = engine.spec();
  for (const sim::Event& event : engine.events()) {
    all.push_back(event);
    // Contacts are daily bread in a crowd; the rest somebody should read now.
    if (log == nullptr || event.kind == sim::EventKind::kContact) continue;
    const bool loss =
        event.kind == sim::EventKind::kProgramFailed || event.kind == sim::EventKind::kDriverFailed;
    log->write(loss ? LogLevel::kError : LogLevel::kWarning,
               fmt::format("robot {}", spec.robots[event.robot.value()].name),
               fmt::format("{:.2f} s: {}: {}", engine.time().seconds(), to_string(event.kind),
                           event.text));
  }
}

std::string events_log(const sim::Engine& engine, const BodyKinds& kinds,
                       const std::vector<sim::Event>& events) {
  std::string text;
  for (const sim::Event& event : events) {
    text +=
        fmt::format("{:10.3f} s  {:<16} {:<14} {}{}\n",
                    static_cast<double>(event.step) * engine.spec().step.seconds(),
                    engine.spec().robots[event.robot.value()].name, to_string(event.kind),
                    event.other.valid() ? fmt::format("with {} ", kinds.name(event.other.value()))
                                        : std::string(),
                    event.text);
  }
  return text;
}

Status write_results(const Findings& findings, const RunOptions& options, RunOutcome& outcome) {
  outcome = judge(findings);
  if (options.picture) {
    const report::Picture picture = make_picture(findings, outcome);
    RAVE_TRY(report::write_svg(picture, options.output / "picture.svg"));
    RAVE_TRY(report::write_png(picture, options.output / "picture.png"));
  }
  outcome.summary = summary_text(findings, outcome);
  RAVE_TRY(write_file_atomically(options.output / "summary.txt", outcome.summary));
  RAVE_TRY(write_file_atomically(options.output / "events.log",
                                 events_log(findings.engine, findings.kinds, findings.events)));
  return write_file_atomically(options.output / "result.json", result_json(findings, outcome));
}

}  // namespace

Result<RunOutcome> run(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                       const RunOptions& options) {
  std::error_code error;
  std::filesystem::create_directories(options.output, error);
  if (error) {
    return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}", options.output.string(),
                error.message());
  }
  RAVE_TRY(
      write_file_atomically(options.output / "scenario.yaml", config::write_expanded(scenario)));

  config::ExpandedScenario adjusted = scenario;
  config::ScenarioFile& file = adjusted.scenario;
  // The check and the frozen instant look back; a second is enough for both.
  if (file.checks.sightings || file.picture) file.history_s = std::max(file.history_s, 1.0);

  WallPace pace(file.pace.factor);
  RAVE_TRY_ASSIGN(BuiltScenario built,
                  build(adjusted, catalogue, {options.program_runner, options.log, &pace}));
  const bool live = !built.live_reason.empty();
  if (live && (file.pace.is_max() || file.pace.factor > 1)) {
    if (options.log != nullptr) {
      options.log->warn("run", "the run goes at real time, because {}", built.live_reason);
    }
    pace.set_factor(1);
  }
  if (!live) built.spec.live_clock = nullptr;
  for (const std::string& note : built.notes) {
    if (options.log != nullptr) options.log->warn("scenario", "{}", note);
  }
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));

  Observers observers(file, built, engine->spec());
  std::vector<sim::Event> events;
  const auto steps = static_cast<std::uint64_t>(std::llround(file.duration_s / file.step_s.value));
  StallWatch watch(options.log);
  // Live drivers count from when they were opened; their clock must not jump.
  if (!live) pace.start();
  const auto begin = Clock::now();
  auto next_progress = begin;
  bool stopped = false;
  while (engine->steps_done() < steps) {
    const auto asked = Clock::now();
    // The world outside a live run goes on, so that is not held.
    const bool held = !live && options.control != nullptr && options.control->paused();
    const bool turn = options.control == nullptr ||
                      (held ? options.control->wait_for_turn() : !options.control->stopping());
    if (!turn) {
      stopped = true;
      break;
    }
    if (held) pace.shift(Clock::now() - asked);
    pace.wait_for(SimTime{static_cast<std::int64_t>(engine->steps_done()) * engine->spec().step.ns},
                  options.control);
    watch.step_begins(engine->steps_done());
    RAVE_TRY(engine->step());
    watch.step_ends();
    observers.after_step(*engine);
    tell_events(*engine, options.log, events);
    const auto now = Clock::now();
    if (options.on_progress && now >= next_progress) {
      next_progress = now + kProgressInterval;
      const double wall_s = std::chrono::duration<double>(now - begin).count();
      const double sim_s = static_cast<double>(engine->steps_done()) * file.step_s.value;
      options.on_progress({sim_s / file.duration_s, sim_s, file.duration_s,
                           wall_s > 0 ? sim_s / wall_s : 0, engine->spec().robots.size(),
                           observers.encounters.headline()});
    }
  }
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  const Findings findings{adjusted,
                          built,
                          observers.kinds,
                          *engine,
                          observers.tracks,
                          observers.encounters,
                          observers.hits,
                          observers.sightings ? &*observers.sightings : nullptr,
                          observers.instant ? &*observers.instant : nullptr,
                          events,
                          wall_s,
                          stopped};
  RunOutcome outcome;
  RAVE_TRY(write_results(findings, options, outcome));
  return outcome;
}

}  // namespace rave::robot_host
