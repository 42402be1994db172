// SPDX-License-Identifier: Apache-2.0
// What recording costs the thread that runs the steps, and what the file takes.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_record.hpp"

namespace {

using namespace rave;
using namespace rave::record;

std::filesystem::path bench_path() {
  return std::filesystem::temp_directory_path() /
         ("rave-bench-record-" + std::to_string(::getpid()) + ".mcap");
}

void write_message(benchmark::State& state) {
  auto writer = McapWriter::open(bench_path());
  const auto channel = writer->add_channel("/x", "cdr", 0);
  const std::vector<std::byte> payload(static_cast<std::size_t>(state.range(0)));
  std::uint32_t i = 0;
  for (auto _ : state) {
    static_cast<void>(writer->write(*channel, i, i, i, payload));
    ++i;
  }
  state.counters["waits"] = static_cast<double>(writer->waits());
  state.SetBytesProcessed(state.iterations() * state.range(0));
  static_cast<void>(writer->close());
  std::filesystem::remove(bench_path());
}
BENCHMARK(write_message)->Arg(24)->Arg(88)->Arg(1024);

/// A step of robots with a moving pose, 16 noisy rays and a command each, at 100 Hz. Argument 1:
/// the record keeps pace with a run in real time (the step waits for the file outside of the
/// measurement every second of simulated time); 0: as fast as it can, disk and compression
/// included.
void record_step(benchmark::State& state) {
  const auto robots = static_cast<std::uint32_t>(state.range(0));
  const bool paced = state.range(1) != 0;
  RunInfo info;
  for (std::uint32_t i = 0; i < robots; ++i) {
    info.robots.push_back({RobotId(i), "robot" + std::to_string(i), "simulated", ""});
  }
  auto recorder = RunRecorder::open(bench_path(), info);
  std::vector<RobotPose> poses(robots);
  std::vector<float> ranges(std::size_t{robots} * 16);
  std::vector<std::byte> commands(std::size_t{robots} * 40);
  std::uint64_t noise = 1;
  std::uint64_t step = 0;
  for (auto _ : state) {
    state.PauseTiming();
    for (std::uint32_t i = 0; i < robots; ++i) {
      noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
      const double x = static_cast<double>(noise >> 40) * 1e-9 + static_cast<double>(step) * 0.003;
      poses[i] = {RobotId(i), Pose2{x, x * 0.5, x * 0.1}, Pose2{x, x * 0.5, x * 0.1}, {x, 0, 0}};
      for (std::size_t k = 0; k < 16; ++k) {
        const float far = static_cast<float>(noise >> (20 + k)) * 1e-13F;
        ranges[i * 16 + k] = k % 2 == 0 ? INFINITY : 1 + far;
      }
    }
    if (paced && step % 10 == 0) static_cast<void>(recorder->flush());
    state.ResumeTiming();
    recorder->begin_step(step, SimTime{static_cast<std::int64_t>(step) * 10'000'000});
    for (std::uint32_t i = 0; i < robots; ++i) {
      recorder->percept({RobotId(i),
                         DeviceId(0),
                         1,
                         PerceptPart::kResult,
                         {0, 1, 16, 1, 0},
                         std::as_bytes(std::span(ranges).subspan(std::size_t{i} * 16, 16))});
      recorder->command({RobotId(i), DeviceId(0), std::span(commands).subspan(i * 40UL, 40)});
    }
    recorder->poses(poses);
    static_cast<void>(recorder->end_step());
    ++step;
  }
  state.SetItemsProcessed(state.iterations() * robots);
  state.counters["waits"] = static_cast<double>(recorder->file().waits());
  static_cast<void>(recorder->end(0));
  state.counters["file_B_per_robot_step"] =
      static_cast<double>(std::filesystem::file_size(bench_path())) /
      static_cast<double>(step * robots);
  std::filesystem::remove(bench_path());
}
BENCHMARK(record_step)
    ->Args({1000, 1})
    ->Args({1000, 0})
    ->Args({10000, 1})
    ->Iterations(500)
    ->Unit(benchmark::kMicrosecond);

/// Opening a file of 1 GB by its index.
void open_gigabyte(benchmark::State& state) {
  {
    auto writer = McapWriter::open(bench_path());
    const auto channel = writer->add_channel("/x", "cdr", 0);
    std::vector<std::uint64_t> payload(8192);
    std::uint64_t noise = 1;
    for (std::uint32_t i = 0; i < (1U << 14); ++i) {
      for (auto& word : payload) {
        word = noise = (noise ^ (noise >> 29)) * 6364136223846793005ULL + 1442695040888963407ULL;
      }
      static_cast<void>(writer->write(*channel, i, i, i, std::as_bytes(std::span(payload))));
    }
    static_cast<void>(writer->close());
  }
  std::uint64_t messages = 0;
  for (auto _ : state) messages = McapReader::open(bench_path())->statistics().message_count;
  state.counters["messages"] = static_cast<double>(messages);
  state.counters["GB"] = static_cast<double>(std::filesystem::file_size(bench_path())) * 1e-9;
  std::filesystem::remove(bench_path());
}
BENCHMARK(open_gigabyte)->Iterations(20)->Unit(benchmark::kMillisecond);

}  // namespace
