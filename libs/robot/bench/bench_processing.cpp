// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "rave/robot/processing.hpp"

namespace {

void apply_noise(benchmark::State& state, const rave::NoiseSpec& noise) {
  const auto rays = static_cast<std::uint32_t>(state.range(0));
  const auto chain =
      rave::Processing::make({noise, 0, {}}, rave::ReadingKind::kRanges, rays, 0.1).value();
  std::vector<float> ranges(rays, 4.0F);
  rave::SampleHeader header;
  std::uint32_t sample = 0;
  for (auto _ : state) {
    header.count = rays;
    chain.apply_noise(header, ranges.data(), rave::RandomStream(1, 2, 3, ++sample));
    benchmark::DoNotOptimize(ranges.data());
    benchmark::ClobberMemory();
  }
  // Seconds per ray: the report prints it with its prefix, `n` for nanoseconds.
  state.counters["per_ray"] = benchmark::Counter(
      rays, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(apply_noise, sigma, rave::NoiseSpec{.length_sigma_m = 0.001})->Arg(16)->Arg(180);
BENCHMARK_CAPTURE(apply_noise, sigma_and_dropout,
                  rave::NoiseSpec{.length_sigma_m = 0.001, .dropout_probability = 0.01})
    ->Arg(16)
    ->Arg(180);
BENCHMARK_CAPTURE(apply_noise, quantum, rave::NoiseSpec{.length_quantum_m = 0.01})
    ->Arg(16)
    ->Arg(180);

}  // namespace
