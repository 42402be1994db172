// SPDX-License-Identifier: Apache-2.0
// What messages cost: robots on a grid of 2 m that each broadcast in every step, with a range in
// which `range_m` decides how many hear it.
#include <benchmark/benchmark.h>

#include "rave/sim_testing/radio_fixture.hpp"

namespace {

using namespace rave;
using namespace rave::sim;
using namespace rave::sim::testing;

void radio_step(benchmark::State& state) {
  const auto count = static_cast<std::uint32_t>(state.range(0));
  EngineSpec spec;
  spec.threads = static_cast<unsigned>(state.range(3));
  RobotType type = simulated_type();
  if (state.range(2) != 0) {
    add_transmitter(type);
    add_communicator(
        type, {{"range_m", static_cast<double>(state.range(1))}, {"loss", 0.05}, {"messages", 64}});
    type.program = program<Beaconing>();
  } else {
    type.program = program<sim::testing::Drive>({{"quiet_after", 1}});
  }
  add_robot(spec, std::move(type));
  std::uint32_t columns = 1;
  while (columns * columns < count) ++columns;
  for (std::uint32_t r = 1; r < count; ++r) {
    add_twin(spec, {2.0 * (r % columns), 2.0 * (r / columns), 0});
  }
  const auto engine = Engine::create(std::move(spec)).value();
  for (auto _ : state) {
    if (!engine->step()) state.SkipWithError("the run ended");
  }
  state.counters["delivered_a_step"] = static_cast<double>(engine->radio_counts().delivered) /
                                       static_cast<double>(state.iterations());
}
// Robots, range in metres, whether they talk at all, threads.
BENCHMARK(radio_step)
    ->Args({1000, 3, 0, 1})
    ->Args({1000, 3, 1, 1})
    ->Args({1000, 6, 1, 1})
    ->Args({1000, 6, 1, 2})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
