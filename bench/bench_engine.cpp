// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "rave/sim/engine.hpp"
#include "rave/sim/world_authority.hpp"
#include "rave/sim_testing/engine_drivers.hpp"

namespace {

using namespace rave;
using namespace rave::sim;
using namespace rave::sim::testing;

/// `count` robots with a laser of 16 rays and 3 m that roam a field, so many metres apart.
EngineSpec crowd(std::uint32_t count, unsigned threads, bool noisy, double apart_m = 2) {
  static constexpr VirtualActuatorOps kWheels = rave::detail::virtual_actuator_ops<Wheels>();
  static constexpr ControllerOps kPass = rave::detail::controller_ops<Pass>();
  EngineSpec spec;
  spec.threads = threads;
  RobotType type;
  SensorSpec laser;
  laser.name = laser.driver = "laser";
  laser.kind = ReadingKind::kRanges;
  laser.virtual_ops = sensor_ops<Laser>();
  laser.params.add_number("rays", 16);
  laser.params.add_number("fov_rad", 4);
  laser.params.add_number("range_m", 3);
  laser.z_m = 0.1;
  if (noisy) laser.processing.noise.length_sigma_m = 0.01;
  type.sensors.push_back(std::move(laser));
  ActuatorSpec wheels;
  wheels.name = wheels.driver = "wheels";
  wheels.virtual_ops = &kWheels;
  type.actuators.push_back(std::move(wheels));
  ControllerSpec drive;
  drive.name = drive.driver = "drive";
  drive.ops = &kPass;
  drive.accepts = CommandKind::kVelocity;
  type.controllers.push_back(std::move(drive));
  type.program.emplace();
  type.program->driver = "roam";
  type.program->ops = program_table<Roam>();
  spec.types.push_back(std::move(type));
  std::uint32_t columns = 1;
  while (columns * columns < count) ++columns;
  for (std::uint32_t r = 0; r < count; ++r) {
    world::Body body;
    body.shapes.push_back(world::make_disc({}, 0.15, 0, 0.3).value());
    body.layer = Layer::kSimulatedRobots;
    spec.world.robots.push_back(std::move(body));
    spec.robots.push_back({std::to_string(r),
                           "",
                           0,
                           {apart_m * (r % columns), apart_m * (r / columns), 0.1 * (r % 60)}});
  }
  return spec;
}

void engine_step(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto engine =
      Engine::create(crowd(count, static_cast<unsigned>(state.range(1)), state.range(2) != 0))
          .value();
  for (auto _ : state) {
    if (!engine->step()) state.SkipWithError("the run ended");
  }
  state.counters["robot_steps"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * count, benchmark::Counter::kIsRate);
}
// Robots, threads, whether ranges have Gaussian noise.
BENCHMARK(engine_step)
    ->Args({1000, 1, 0})
    ->Args({1000, 1, 1})
    ->Args({1000, 2, 0})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

/// A step of few robots in an empty world: it must not cost more the farther they are apart.
void far_apart(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto engine =
      Engine::create(crowd(count, 1, false, static_cast<double>(state.range(1)))).value();
  for (auto _ : state) {
    if (!engine->step()) state.SkipWithError("the run ended");
  }
}
// Robots, metres between them.
BENCHMARK(far_apart)
    ->Args({3, 10})
    ->Args({3, 3000})
    ->Args({1000, 10})
    ->Args({1000, 300})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

/// The same crowd on several hosts, all of them and the authority one after the other in this
/// thread: what sharing a world costs, without what carries the messages.
void shared_step(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  const auto shares = static_cast<std::uint32_t>(state.range(1));
  std::vector<std::uint32_t> host_of(count);
  for (std::uint32_t r = 0; r < count; ++r) host_of[r] = r * shares / count;
  const auto authority = WorldAuthority::create(crowd(count, 1, false), host_of).value();
  std::vector<std::unique_ptr<Engine>> hosts;
  std::vector<HostReport> reports(shares);
  std::vector<const HostReport*> all;
  for (std::uint32_t h = 0; h < shares; ++h) {
    EngineSpec spec = crowd(count, 1, false);
    spec.local.emplace();
    for (std::uint32_t r = 0; r < count; ++r) {
      if (host_of[r] == h) spec.local->emplace_back(r);
    }
    hosts.push_back(Engine::create(std::move(spec)).value());
    reports[h].host = h;
    all.push_back(&reports[h]);
  }
  WorldStep world;
  for (auto _ : state) {
    bool good = true;
    for (std::uint32_t h = 0; h < shares; ++h) {
      good = good && hosts[h]->propose(reports[h]).has_value();
    }
    good = good && authority->step(all, world).has_value();
    for (const auto& host : hosts) good = good && host->apply(world).has_value();
    if (!good) state.SkipWithError("the run ended");
  }
  state.counters["robot_steps"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * count, benchmark::Counter::kIsRate);
}
// Robots, hosts.
BENCHMARK(shared_step)
    ->Args({1000, 1})
    ->Args({1000, 3})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
