// SPDX-License-Identifier: Apache-2.0
// The parts of a step by themselves, in the workloads of `rave bench swarm`: a robot on 10 m^2,
// half as many boxes, four walls. How to run it and what it measures: docs/benchmarks.md.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>

#include "contact_arena.hpp"
#include "instances.hpp"
#include "listed_fan.hpp"
#include "rave/sim/range_engine.hpp"
#include "rave/sim_testing/engine_drivers.hpp"

namespace {

using namespace rave;
using namespace rave::sim;
using namespace rave::sim::testing;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Time per robot, ray or draw, as a counter that the JSON output carries.
void per_item(benchmark::State& state, const char* name, double items) {
  state.counters[name] =
      benchmark::Counter(static_cast<double>(state.iterations()) * items * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// The field of the swarm workloads with discs of 0.15 m on a jittered grid, none in a box.
std::unique_ptr<ContactArena> field(std::uint32_t robots) {
  auto arena = std::make_unique<ContactArena>();
  RandomStream random(1, 0, 0, 0);
  std::uint32_t columns = 1;
  while (columns * columns < robots) ++columns;
  const double spacing_m = std::sqrt(10.0);
  const double side_m = spacing_m * columns;
  for (const double at_m : {0.0, side_m}) {
    arena->model.obstacles.push_back(standing(square_robot(0.1, side_m), {at_m, side_m / 2, 0}));
    arena->model.obstacles.push_back(standing(square_robot(side_m, 0.1), {side_m / 2, at_m, 0}));
  }
  for (std::uint32_t i = 0; i < columns * columns; ++i) {
    const std::uint32_t row = i / columns;
    const Vec2 corner{spacing_m * (i % columns), spacing_m * row};
    // The box keeps to one half of its square, so that robots and boxes do not overlap at first.
    if (i % 2 == 0) {
      arena->model.obstacles.push_back(
          standing(square_robot(random.uniform(0.4, 1), random.uniform(0.4, 1)),
                   {corner.x + random.uniform(0.8, 0.9), corner.y + random.uniform(0.8, 2.3),
                    random.uniform(-3, 3)}));
    }
    if (i >= robots) continue;
    arena->add(round_robot(0.15), {corner.x + random.uniform(1.9, 2.9),
                                   corner.y + random.uniform(0.3, 2.9), random.uniform(-3, 3)});
  }
  arena->begin();
  for (Twist2& twist : arena->proposal) {
    twist = {0.4, 0, random.bits() % 4 == 0 ? 0.8 : 0.0};
  }
  return arena;
}

void contacts(benchmark::State& state) {
  const auto robots = static_cast<std::uint32_t>(state.range(0));
  const auto arena = field(robots);
  // Two metres straight on bring some of them to a box or to one another.
  for (int k = 0; k < 50; ++k) arena->step(0.1);
  const std::vector<Mover> start = arena->movers;
  double resolved = 0;
  for (auto _ : state) {
    // Always the same step, or the robots would end at the walls.
    std::copy(start.begin(), start.end(), arena->movers.begin());
    const auto begin = Clock::now();
    arena->phase->run(
        *arena->snapshot, 0.1,
        {arena->movers, arena->proposal, arena->velocity, arena->limited, arena->touch},
        arena->notes);
    state.SetIterationTime(seconds_since(begin));
    resolved += static_cast<double>(arena->phase->resolved());
  }
  per_item(state, "ns_per_robot", robots);
  state.counters["resolved_share"] =
      benchmark::Counter(resolved / robots, benchmark::Counter::kAvgIterations);
}
BENCHMARK(contacts)->Arg(1000)->Arg(10'000)->Arg(100'000)->UseManualTime();

/// As a step does it: each robot is set, placed and sorted into the index.
void index_rebuild(benchmark::State& state) {
  const auto robots = static_cast<std::uint32_t>(state.range(0));
  const auto arena = field(robots);
  for (auto _ : state) {
    for (std::uint32_t r = 0; r < robots; ++r) {
      const Pose2& X_WR = arena->movers[r].X_WR;
      arena->snapshot->set_robot(RobotId(r), {X_WR, {}, true});
    }
    arena->snapshot->rebuild();
  }
  per_item(state, "ns_per_robot", robots);
}
BENCHMARK(index_rebuild)->Arg(1000)->Arg(10'000)->Arg(100'000);

/// The sort alone.
void index_sort(benchmark::State& state) {
  const auto robots = static_cast<std::uint32_t>(state.range(0));
  const auto arena = field(robots);
  for (auto _ : state) arena->snapshot->index_robots(0);
  per_item(state, "ns_per_robot", robots);
}
BENCHMARK(index_sort)->Arg(1000)->Arg(10'000)->Arg(100'000);

FanTable fan_of(std::uint32_t rays, std::int64_t degrees, std::int64_t metres) {
  const double field_rad = deg_to_rad(static_cast<double>(degrees));
  const double gaps = degrees == 360 ? rays : std::max(rays - 1, 1U);
  std::vector<double> bearings_rad;
  for (std::uint32_t i = 0; i < rays; ++i) {
    bearings_rad.push_back(field_rad * (double{1} * i / gaps - 0.5));
  }
  FanQuery query;
  query.bearings_rad = bearings_rad.data();
  query.ray_count = rays;
  query.rays_per_reading = 1;
  query.range_max_m = static_cast<double>(metres);
  return FanTable::make(query, kAllLayers);
}

/// The fans of all robots of a field.
void cast_all(benchmark::State& state, std::uint32_t robots, const FanTable& fan,
              decltype(&cast_fan_along) cast) {
  const auto arena = field(robots);
  FanScratch scratch;
  std::vector<float> ranges(fan.rays);
  std::vector<std::uint32_t> bodies(fan.rays);
  for (auto _ : state) {
    for (std::uint32_t r = 0; r < robots; ++r) {
      cast(*arena->snapshot, fan, sensor_place(arena->movers[r].X_WR, Pose2{}), 0.1,
           arena->snapshot->body_of(RobotId(r)), scratch, ranges, bodies);
    }
    benchmark::DoNotOptimize(ranges.data());
  }
  per_item(state, "ns_per_robot", robots);
  per_item(state, "ns_per_ray", static_cast<double>(robots) * fan.rays);
}

/// Arguments are robots, rays, degrees, metres.
void range_kernel(benchmark::State& state) {
  cast_all(state, static_cast<std::uint32_t>(state.range(0)),
           fan_of(static_cast<std::uint32_t>(state.range(1)), state.range(2), state.range(3)),
           cast_fan);
}
BENCHMARK(range_kernel)
    ->Args({1000, 16, 360, 3})
    ->Args({10'000, 16, 360, 3})
    ->Args({1000, 180, 180, 8})
    ->Args({10'000, 180, 180, 8});

/// Few rays over a long way. Arguments are rays, degrees, metres, and 0 to look all around, 1 to
/// look along each ray, 2 for what is expected to take less.
void ray_walk(benchmark::State& state) {
  using Cast = decltype(&cast_fan_along);
  constexpr Cast kWays[] = {cast_fan_around, cast_fan_along, cast_fan};
  cast_all(state, 1000,
           fan_of(static_cast<std::uint32_t>(state.range(0)), state.range(1), state.range(2)),
           kWays[state.range(3)]);
}
BENCHMARK(ray_walk)->ArgsProduct({{1, 4, 16}, {60, 360}, {3, 8, 30, 100}, {0, 1, 2}});

/// A line of sight from each of 1000 robots to one so many metres away.
void line_of_sight(benchmark::State& state) {
  constexpr std::uint32_t kRobots = 1000;
  const auto arena = field(kRobots);
  const auto metres = static_cast<double>(state.range(0));
  for (auto _ : state) {
    int seen = 0;
    for (std::uint32_t r = 0; r < kRobots; ++r) {
      const Pose2& X_WR = arena->movers[r].X_WR;
      const SinCos turn = sincos(X_WR.yaw);
      const Vec2 there = X_WR.position() + metres * Vec2{turn.cos, turn.sin};
      seen += arena->snapshot->visible(X_WR.position(), there, 0.1, kAllLayers,
                                       arena->snapshot->body_of(RobotId(r)), BodyId())
                  ? 1
                  : 0;
    }
    benchmark::DoNotOptimize(seen);
  }
  per_item(state, "ns_per_robot", kRobots);
}
BENCHMARK(line_of_sight)->Arg(3)->Arg(10)->Arg(30)->Arg(100);

/// Streams as a sensor makes them: one per robot and sample, here with 16 draws each.
void random_numbers(benchmark::State& state) {
  constexpr int kDraws = 16;
  std::uint32_t sample = 0;
  for (auto _ : state) {
    RandomStream random(1, 2, 3, ++sample);
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) sum += random.uniform();
    benchmark::DoNotOptimize(sum);
  }
  per_item(state, "ns_per_draw", kDraws);
}
BENCHMARK(random_numbers);

/// Looks at nothing, commands nothing: what is left is the call.
class Idle final : public DecisionProcess {
 public:
  Status start(const Setup& /*setup*/) override { return {}; }
  void decide(const Percepts& /*percepts*/, Commands& /*commands*/) override { ++decisions_; }

 private:
  std::uint64_t decisions_ = 0;
};

/// A block of 64 programs through the table of functions that a plug-in hands over.
void plugin_call(benchmark::State& state) {
  constexpr std::size_t kPrograms = 64;
  const ProgramOps* ops = program_table<Idle>();
  benchmark::DoNotOptimize(ops);  // or the compiler would see through the table
  InstanceArray programs;
  if (!programs.make(ops->instance, kPrograms)) state.SkipWithError("no programs");
  const std::vector<DecideItem> items(kPrograms);
  std::vector<std::uint8_t> failed(kPrograms);
  ErrorText error;
  for (auto _ : state) {
    ops->decide(programs.at(0), programs.stride(), items.data(), kPrograms, failed.data(), &error);
    benchmark::ClobberMemory();
  }
  per_item(state, "ns_per_call", kPrograms);
}
BENCHMARK(plugin_call);

}  // namespace
