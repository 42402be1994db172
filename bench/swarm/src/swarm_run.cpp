// SPDX-License-Identifier: Apache-2.0
#include "rave/swarm/swarm_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "memory.hpp"
#include "rave/assemble/build.hpp"
#include "rave/sim/engine.hpp"

namespace rave::swarm {
namespace {

using Clock = std::chrono::steady_clock;

/// Of a run of so many steps the first twentieth is not measured, and no more than kWarmUp steps.
constexpr std::uint64_t kWarmUp = 20;
constexpr std::uint64_t kWarmUpShare = 20;

std::int64_t clock_ns() noexcept {
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

Status check(const RunEnd& end) {
  if (end.steps.has_value() == end.seconds.has_value()) {
    return fail(ErrorCode::kInvalidArgument, "expected either a number of steps or of seconds");
  }
  if (end.steps && *end.steps == 0) {
    return fail(ErrorCode::kInvalidArgument, "0 steps; expected at least 1");
  }
  if (end.seconds && !(*end.seconds > 0)) {
    return fail(ErrorCode::kInvalidArgument, "{} seconds; expected more than 0", *end.seconds);
  }
  return {};
}

/// The catalogue outlives the engine. The scenario is gone when this returns: it is as large as a
/// part of the engine, and not needed any more.
Result<std::unique_ptr<sim::Engine>> make_engine(const Workload& workload,
                                                 plugin::Catalogue& catalogue, LogSink* log) {
  // The duration is for files; nothing in the engine depends on it.
  RAVE_TRY_ASSIGN(auto scenario, make_scenario(workload, 1));
  RAVE_TRY_ASSIGN(auto built, runtime::build(scenario, catalogue, {{}, log, nullptr}));
  scenario = {};
  built.spec.phase_clock = &clock_ns;
  return sim::Engine::create(std::move(built.spec));
}

/// A program or driver that failed makes the rest of a run cheaper, and worth nothing.
Status check_events(const sim::Engine& engine) {
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kProgramFailed &&
        event.kind != sim::EventKind::kDriverFailed) {
      continue;
    }
    return fail(ErrorCode::kPlugin, "robot `{}` in step {}: {}",
                engine.spec().robots[event.robot.value()].name, event.step, event.text);
  }
  return {};
}

Status take_step(sim::Engine& engine) {
  RAVE_TRY(engine.step());
  return check_events(engine);
}

Status measure(sim::Engine& engine, const RunEnd& end, SwarmRun& run) {
  const std::uint64_t warm_up =
      end.steps ? std::min(*end.steps / kWarmUpShare, kWarmUp) : std::uint64_t{1};
  while (engine.steps_done() < warm_up) RAVE_TRY(take_step(engine));
  const sim::PhaseTimes before = engine.phase_times();
  const Clock::time_point begin = Clock::now();
  do {
    RAVE_TRY(take_step(engine));
  } while (end.steps ? engine.steps_done() < *end.steps : seconds_since(begin) < *end.seconds);
  run.wall_s = seconds_since(begin);
  run.steps = engine.steps_done();
  run.measured_steps = run.steps - warm_up;
  for (std::size_t p = 0; p < sim::kPhases; ++p) {
    run.phases.ns[p] = engine.phase_times().ns[p] - before.ns[p];
  }
  return {};
}

void take_rates(SwarmRun& run) {
  run.steps_per_s = static_cast<double>(run.measured_steps) / run.wall_s;
  run.robot_steps_per_s = run.steps_per_s * run.workload.robots;
  run.rays_per_s = run.robot_steps_per_s * rays_of(run.workload.sensing);
  run.rtf = run.steps_per_s * kStep_s;
}

double mean_displacement_m(const sim::Engine& engine) {
  double sum_m = 0;
  const auto& robots = engine.spec().robots;
  for (std::uint32_t r = 0; r < robots.size(); ++r) {
    const Vec2 way = engine.true_pose(RobotId(r)).position() - robots[r].X_WR.position();
    sum_m += std::sqrt(squared_norm(way));
  }
  return sum_m / static_cast<double>(robots.size());
}

double mean_range_m(const sim::Engine& engine, double farthest_m) {
  double sum_m = 0;
  std::uint64_t count = 0;
  for (std::uint32_t r = 0; r < engine.spec().robots.size(); ++r) {
    const sim::SensorSample sample = engine.sensor(RobotId(r), 0);
    const auto* const ranges_m = static_cast<const float*>(sample.records);
    for (std::uint32_t i = 0; i < sample.header->count; ++i, ++count) {
      sum_m += std::min(static_cast<double>(ranges_m[i]), farthest_m);
    }
  }
  return count == 0 ? 0 : sum_m / static_cast<double>(count);
}

}  // namespace

Result<SwarmRun> run_swarm(const Workload& workload, const RunEnd& end,
                           plugin::Catalogue& catalogue, LogSink* log,
                           std::chrono::steady_clock::time_point began) {
  RAVE_TRY(check(end));
  SwarmRun run;
  run.workload = workload;
  run.rss_start_mb = resident_mb();
  RAVE_TRY_ASSIGN(const auto engine, make_engine(workload, catalogue, log));
  run.startup_s = seconds_since(began);
  RAVE_TRY(measure(*engine, end, run));
  take_rates(run);
  run.rss_mb = peak_resident_mb();
  run.mean_disp_m = mean_displacement_m(*engine);
  run.mean_range_m = mean_range_m(*engine, range_max_m(workload.sensing));
  run.hash = engine->hash().value();
  return run;
}

std::string swarm_json(const SwarmRun& run) {
  const double robot_steps =
      static_cast<double>(run.measured_steps) * static_cast<double>(run.workload.robots);
  nlohmann::ordered_json phases;
  for (std::size_t p = 0; p < sim::kPhases; ++p) {
    const auto phase = static_cast<sim::Phase>(p);
    phases[std::string(sim::to_string(phase))] =
        static_cast<double>(run.phases.of(phase)) / robot_steps;
  }
  const nlohmann::ordered_json json = {{"workload", to_string(run.workload.sensing)},
                                       {"robots", run.workload.robots},
                                       {"threads", run.workload.threads},
                                       {"noise", to_string(run.workload.noise)},
                                       {"seed", run.workload.seed},
                                       {"steps", run.steps},
                                       {"measured_steps", run.measured_steps},
                                       {"wall_s", run.wall_s},
                                       {"steps_per_s", run.steps_per_s},
                                       {"robot_steps_per_s", run.robot_steps_per_s},
                                       {"rays_per_s", run.rays_per_s},
                                       {"rtf", run.rtf},
                                       {"startup_s", run.startup_s},
                                       {"rss_mb", run.rss_mb},
                                       {"rss_start_mb", run.rss_start_mb},
                                       {"mean_disp_m", run.mean_disp_m},
                                       {"mean_range_m", run.mean_range_m},
                                       {"hash", fmt::format("{:016x}", run.hash)},
                                       {"phases", phases}};
  return json.dump();
}

}  // namespace rave::swarm
