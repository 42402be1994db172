// SPDX-License-Identifier: Apache-2.0
// The parts of a step by themselves, in the workloads of `rave bench swarm`: a robot on 10 m^2,
// half as many boxes, four walls. How to run it and what it measures: docs/design/engine.md.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>

#include "contact_arena.hpp"
#include "engine_drivers.hpp"
#include "instances.hpp"
#include "rave/sim/range_engine.hpp"

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

/// The fans of all robots of a field: arguments are robots, rays, degrees, metres.
void range_kernel(benchmark::State& state) {
  const auto robots = static_cast<std::uint32_t>(state.range(0));
  const auto rays = static_cast<std::uint32_t>(state.range(1));
  const bool full_circle = state.range(2) == 360;
  const double field_rad = deg_to_rad(static_cast<double>(state.range(2)));
  const auto arena = field(robots);
  std::vector<double> bearings_rad;
  const double gaps = full_circle ? rays : rays - 1;
  for (std::uint32_t i = 0; i < rays; ++i) {
    bearings_rad.push_back(field_rad * (double{1} * i / gaps - 0.5));
  }
  FanQuery query;
  query.bearings_rad = bearings_rad.data();
  query.ray_count = rays;
  query.rays_per_reading = 1;
  query.range_max_m = static_cast<double>(state.range(3));
  const FanTable fan = FanTable::make(query, kAllLayers);
  FanScratch scratch;
  std::vector<float> ranges(rays);
  std::vector<std::uint32_t> bodies(rays);
  for (auto _ : state) {
    for (std::uint32_t r = 0; r < robots; ++r) {
      cast_fan(*arena->snapshot, fan, sensor_place(arena->movers[r].X_WR, Pose2{}), 0.1,
               arena->snapshot->body_of(RobotId(r)), scratch, ranges, bodies);
    }
    benchmark::DoNotOptimize(ranges.data());
  }
  per_item(state, "ns_per_robot", robots);
  per_item(state, "ns_per_ray", static_cast<double>(robots) * rays);
}
BENCHMARK(range_kernel)
    ->Args({1000, 16, 360, 3})
    ->Args({10'000, 16, 360, 3})
    ->Args({1000, 180, 180, 8})
    ->Args({10'000, 180, 180, 8});

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
