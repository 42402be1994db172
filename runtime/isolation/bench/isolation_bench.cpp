// SPDX-License-Identifier: Apache-2.0
// What isolation costs: one decision of n isolated programs at once, and one start.

#include <benchmark/benchmark.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rave/isolation/isolated_program.hpp"

namespace {

using rave::isolation::IsolatedProgram;
using rave::isolation::IsolationOptions;

constexpr std::uint32_t kRays = 180;

/// A robot with a laser and a drive, and a program that does nothing.
class Robot {
 public:
  Robot() {
    sensor_.name = "laser";
    sensor_.kind = rave::ReadingKind::kRanges;
    sensor_.capacity = kRays;
    sensor_.bearings_rad = bearings_rad_.data();
    view_ = {&header_, ranges_m_.data()};
    header_.count = kRays;
  }
  bool start() {
    IsolationOptions options;
    options.runner = std::filesystem::path(RAVE_BINARY_DIR) / "bin/rave-program-runner";
    options.plugin =
        std::filesystem::path(RAVE_BINARY_DIR) / "bench/plugins/isolation_bench_idle.so";
    options.program = "idle";
    rave::ProgramSetup setup;
    setup.robot.name = "anna";
    setup.sensors = &sensor_;
    setup.sensor_count = 1;
    setup.controllers = &controller_;
    setup.controller_count = 1;
    auto program = IsolatedProgram::start(options, setup);
    if (program) program_ = *std::move(program);
    return program_ != nullptr;
  }
  bool begin(std::uint32_t k) { return program_->begin_decide(item(k)).has_value(); }
  bool end(std::uint32_t k) { return program_->end_decide(item(k)).has_value(); }

 private:
  rave::DecideItem item(std::uint32_t k) {
    rave::DecideItem item;
    item.sensors = &view_;
    item.commands = &command_;
    item.decision = k;
    return item;
  }
  rave::SensorInfo sensor_;
  rave::ControllerInfo controller_{"drive", rave::CommandKind::kVelocity, 0};
  rave::SampleHeader header_;
  std::array<double, kRays> bearings_rad_{};
  std::array<float, kRays> ranges_m_{};
  rave::SensorView view_;
  rave::Command command_;
  std::unique_ptr<IsolatedProgram> program_;
};

void decide(benchmark::State& state) {
  std::vector<std::unique_ptr<Robot>> robots;
  for (int i = 0; i < state.range(0); ++i) {
    robots.push_back(std::make_unique<Robot>());
    if (!robots.back()->start()) return state.SkipWithError("cannot start");
  }
  std::uint32_t k = 0;
  for (auto _ : state) {
    for (auto& robot : robots) benchmark::DoNotOptimize(robot->begin(k));
    for (auto& robot : robots) benchmark::DoNotOptimize(robot->end(k));
    ++k;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(decide)->Arg(1)->Arg(10)->Arg(50)->UseRealTime()->Unit(benchmark::kMicrosecond);

void start(benchmark::State& state) {
  for (auto _ : state) {
    Robot robot;
    if (!robot.start()) return state.SkipWithError("cannot start");
  }
}
BENCHMARK(start)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
