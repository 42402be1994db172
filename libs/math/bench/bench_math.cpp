// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "rave/math/gaussian.hpp"
#include "rave/math/polygon.hpp"
#include "rave/math/random_batch.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave {
namespace {

/// 1024 arguments, so that branches cannot be learnt by heart.
std::array<double, 1024> arguments(double low, double high) {
  std::array<double, 1024> values{};
  RandomStream random(1, 0, 0, 0);
  for (double& value : values) value = random.uniform(low, high);
  return values;
}

template <class Function>
void run(benchmark::State& state, double low, double high, Function function) {
  const auto values = arguments(low, high);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(function(values[i]));
    i = (i + 1) % values.size();
  }
}

void bench_sincos(benchmark::State& state) {
  run(state, -4, 4, [](double x) { return sincos(x); });
}
void bench_sincos_huge(benchmark::State& state) {
  run(state, 1e7, 1e300, [](double x) { return sincos(x); });
}
void bench_atan2(benchmark::State& state) {
  run(state, -3, 3, [](double x) { return atan2(x, 1.0 - x); });
}
void bench_exp(benchmark::State& state) {
  run(state, -20, 20, [](double x) { return exp(x); });
}
void bench_log(benchmark::State& state) {
  run(state, 0, 20, [](double x) { return log(x); });
}
void bench_gaussian(benchmark::State& state) {
  RandomStream stream(1, 2, 3, 4);
  for (auto _ : state) benchmark::DoNotOptimize(gaussian(stream));
}

/// Seconds per number: the report prints it with its prefix, `n` for nanoseconds.
template <class Number, class Fill>
void fill(benchmark::State& state, const Fill& fill) {
  std::vector<Number> numbers(static_cast<std::size_t>(state.range(0)));
  std::uint32_t sample = 0;
  for (auto _ : state) {
    fill(RandomStream(1, 2, 3, ++sample), std::span(numbers));
    benchmark::DoNotOptimize(numbers.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_number"] = benchmark::Counter(
      static_cast<double>(numbers.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void bench_fill_bits(benchmark::State& state) {
  fill<std::uint32_t>(state, [](const RandomStream& stream, auto out) { fill_bits(stream, out); });
}
void bench_fill_normal(benchmark::State& state) {
  fill<float>(state, [](const RandomStream& stream, auto out) { fill_normal(stream, out); });
}

void bench_distance(benchmark::State& state) {
  const auto a = regular_polygon(static_cast<int>(state.range(0)), 0.3);
  const auto b = ConvexPolygon::box(2, 0.2).value();
  run(state, -3, 3, [&](double x) { return distance(a, {x, 1, x}, b, {0, 0, 0.2}); });
}

void bench_time_of_impact(benchmark::State& state) {
  const auto a = regular_polygon(static_cast<int>(state.range(0)), 0.3);
  const auto b = ConvexPolygon::box(2, 0.2).value();
  run(state, -1, 1, [&](double x) {
    return time_of_impact(a, {x, 0.45, x}, {0.05, -0.1, 0.1}, b, {0, 0, 0});
  });
}

BENCHMARK(bench_sincos);
BENCHMARK(bench_sincos_huge);
BENCHMARK(bench_atan2);
BENCHMARK(bench_exp);
BENCHMARK(bench_log);
BENCHMARK(bench_gaussian);
BENCHMARK(bench_fill_bits)->Arg(16)->Arg(180)->Arg(4096);
BENCHMARK(bench_fill_normal)->Arg(16)->Arg(180)->Arg(4096);
BENCHMARK(bench_distance)->Arg(4)->Arg(16)->Arg(64);
BENCHMARK(bench_time_of_impact)->Arg(4)->Arg(16);

}  // namespace
}  // namespace rave
