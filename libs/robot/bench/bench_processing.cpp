// SPDX-License-Identifier: Apache-2.0
// What the processing of ranges costs. The engine hands over a block of robots at once.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "rave/robot/processing.hpp"

namespace {

using namespace rave;

/// Readings of `robots` robots of `rays` rays each, side by side.
struct Readings {
  Readings(std::uint32_t robots, std::uint32_t rays)
      : ranges(std::size_t{robots} * rays, 4.0F), headers(robots) {
    for (SampleHeader& header : headers) header.count = rays;
  }
  [[nodiscard]] float* of(std::size_t robot) {
    return ranges.data() + robot * (ranges.size() / headers.size());
  }

  std::vector<float> ranges;
  std::vector<SampleHeader> headers;
};

/// Seconds per ray: the report prints it with its prefix, `n` for nanoseconds.
void count_rays(benchmark::State& state, std::size_t rays) {
  state.counters["per_ray"] =
      benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}

/// Arguments: robots, rays.
void noise(benchmark::State& state, const NoiseSpec& noise) {
  const auto rays = static_cast<std::uint32_t>(state.range(1));
  Readings readings(static_cast<std::uint32_t>(state.range(0)), rays);
  const auto chain = Processing::make({noise, 0, {}}, ReadingKind::kRanges, rays, 0.1).value();
  std::vector<NoiseItem> items;
  std::uint32_t sample = 0;
  for (auto _ : state) {
    items.clear();
    ++sample;
    for (std::uint32_t robot = 0; robot < readings.headers.size(); ++robot) {
      items.push_back({&readings.headers[robot], readings.of(robot), {1, robot, 3, sample}});
    }
    chain.apply_noise(items);
    benchmark::DoNotOptimize(readings.ranges.data());
    benchmark::ClobberMemory();
  }
  count_rays(state, readings.ranges.size());
}

void shapes(benchmark::internal::Benchmark* bench) {
  for (const int rays : {16, 180}) {
    for (const int robots : {1, 64}) bench->Args({robots, rays});
  }
}
BENCHMARK_CAPTURE(noise, sigma, NoiseSpec{.length_sigma_m = 0.001})->Apply(shapes);
BENCHMARK_CAPTURE(noise, sigma_and_dropout,
                  NoiseSpec{.length_sigma_m = 0.001, .dropout_probability = 0.01})
    ->Apply(shapes);
BENCHMARK_CAPTURE(noise, sigma_and_quantum,
                  NoiseSpec{.length_sigma_m = 0.001, .length_quantum_m = 0.01})
    ->Apply(shapes);
BENCHMARK_CAPTURE(noise, quantum, NoiseSpec{.length_quantum_m = 0.01})->Apply(shapes);

/// The whole chain of one robot after the other: into the ring, through the filters, out.
void chain(benchmark::State& state, const ProcessingSpec& spec) {
  const auto rays = static_cast<std::uint32_t>(state.range(1));
  Readings raw(static_cast<std::uint32_t>(state.range(0)), rays);
  Readings out = raw;
  const auto chain = Processing::make(spec, ReadingKind::kRanges, rays, 0.1).value();
  std::vector<std::uint64_t> memory(chain.state_size() / 8 * raw.headers.size());
  const auto state_of = [&](std::size_t robot) {
    return reinterpret_cast<std::byte*>(memory.data()) + chain.state_size() * robot;
  };
  for (std::size_t robot = 0; robot < raw.headers.size(); ++robot) chain.reset(state_of(robot));
  std::vector<float> scene(4096);
  RandomStream random(1, 2, 3, 4);
  for (float& range : scene) range = static_cast<float>(random.uniform(0.1, 8));
  std::int64_t now_ns = 0;
  std::uint32_t sample = 0;
  for (auto _ : state) {
    now_ns += 100'000'000;
    ++sample;
    for (std::uint32_t robot = 0; robot < raw.headers.size(); ++robot) {
      SampleHeader header = raw.headers[robot];
      header.stamp_ns = now_ns;
      float* const ranges = raw.of(robot);
      // Other readings each time, or the median would learn their order by heart.
      const std::size_t start = (sample * 977 + robot * 31) % (scene.size() - rays);
      std::copy_n(scene.begin() + static_cast<std::ptrdiff_t>(start), rays, ranges);
      chain.push(header, ranges, {1, robot, 3, sample}, state_of(robot));
      chain.deliver({now_ns}, state_of(robot), &out.headers[robot], out.of(robot));
    }
    benchmark::ClobberMemory();
  }
  count_rays(state, raw.ranges.size());
}

FilterSpec median(int window) { return {.window = window}; }
FilterSpec exponential() {
  return {.kind = FilterSpec::Kind::kExponential, .time_constant_s = 0.3};
}
BENCHMARK_CAPTURE(chain, ring_alone, ProcessingSpec{})->Apply(shapes);
BENCHMARK_CAPTURE(chain, exponential, ProcessingSpec{.filters = {exponential()}})->Apply(shapes);
BENCHMARK_CAPTURE(chain, median_3, ProcessingSpec{.filters = {median(3)}})->Apply(shapes);
BENCHMARK_CAPTURE(chain, median_5, ProcessingSpec{.filters = {median(5)}})->Apply(shapes);
BENCHMARK_CAPTURE(chain, median_9, ProcessingSpec{.filters = {median(9)}})->Apply(shapes);

}  // namespace
