// SPDX-License-Identifier: Apache-2.0
// What recording costs a step of 1000 robots with 16 rays of 3 m each: two engines of one scenario
// take turns in one thread, one of them recorded. Prints JSON. Usage: bench_recording [PLUGINS]
#include <fmt/format.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/recording/record_keeper.hpp"

namespace rave::runtime {
namespace {

namespace fs = std::filesystem;

constexpr int kWarmUpSteps = 200;
constexpr int kBlocks = 60;
constexpr int kBlockSteps = 25;

// A robot on 4 m^2. `PERIOD` is that of laser and program.
constexpr std::string_view kScenario = R"(
name: crowd
duration_s: 1000
robots:
  - name: robot
    scatter: {count: 1000, x_m: [0, 63], y_m: [0, 63], clearance_m: 0.1}
    robot:
      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}
      sensors:
        - {name: laser, driver: virtual_laser, mount: {z_m: 0.1}, period_s: PERIOD, params: {rays: 16, fov_deg: 240, range_max_m: 3}}
      actuators: [{name: wheels, driver: differential_drive}]
      controllers: [{name: drive, driver: velocity, actuator: wheels}]
      program: {driver: wander, period_s: PERIOD}
)";

/// Microseconds of the wall and of this thread's processor time.
struct Spent {
  double wall_us = 0;
  double thread_us = 0;
  double keeper_us = 0;  ///< Of thread_us: what the recorder itself takes.
};

double thread_now_us() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

/// One engine, recorded or not.
class Side {
 public:
  Side(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
       const fs::path& record) {
    auto built = build(scenario, catalogue, BuildOptions{}).value();
    kinds_ = std::make_unique<BodyKinds>(built.spec, built.robot_kinds);
    engine_ = sim::Engine::create(std::move(built.spec)).value();
    if (record.empty()) return;
    keeper_ = RecordKeeper::open(record, *engine_, *kinds_, runtime::info_of(*engine_, *kinds_), {},
                                 nullptr)
                  .value();
  }
  /// Per step.
  Spent run(int steps) {
    const auto wall = std::chrono::steady_clock::now();
    const double thread_us = thread_now_us();
    double keeper_us = 0;
    for (int i = 0; i < steps; ++i) {
      if (!engine_->step()) std::abort();
      if (!keeper_) continue;
      const double begin_us = thread_now_us();
      keeper_->keep(*engine_);
      keeper_us += thread_now_us() - begin_us;
    }
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - wall;
    return {took.count() / steps, (thread_now_us() - thread_us) / steps, keeper_us / steps};
  }
  [[nodiscard]] std::uint64_t hash() const { return engine_->hash().value(); }
  [[nodiscard]] std::uint64_t waits() const { return keeper_->recorder().file().waits(); }
  void end() { static_cast<void>(keeper_->end(hash())); }

 private:
  std::unique_ptr<BodyKinds> kinds_;
  std::unique_ptr<sim::Engine> engine_;
  std::unique_ptr<RecordKeeper> keeper_;
};

std::string spread(std::string_view name, std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return fmt::format(R"("{}": {{"median": {:.4f}, "p10": {:.4f}, "p90": {:.4f}}})", name, at(0.5),
                     at(0.1), at(0.9));
}

std::string measure(plugin::Catalogue& catalogue, const std::string& period_s) {
  std::string text(kScenario);
  for (std::size_t at; (at = text.find("PERIOD")) != std::string::npos;) {
    text.replace(at, 6, period_s);
  }
  const auto scenario = config::expand_scenario_text(text, "crowd.yaml").value();
  const fs::path file =
      fs::temp_directory_path() / fmt::format("rave-bench-recording-{}.mcap", ::getpid());
  Side plain(scenario, catalogue, {});
  Side recorded(scenario, catalogue, file);
  plain.run(kWarmUpSteps);
  recorded.run(kWarmUpSteps);
  std::vector<double> plain_us, recorded_us, keeper_us, wall_ratio, thread_ratio;
  for (int block = 0; block < kBlocks; ++block) {
    // Whoever comes second finds a warmer machine, so they take turns in that as well.
    Spent a, b;
    if (block % 2 == 0) a = plain.run(kBlockSteps);
    b = recorded.run(kBlockSteps);
    if (block % 2 != 0) a = plain.run(kBlockSteps);
    plain_us.push_back(a.wall_us);
    recorded_us.push_back(b.wall_us);
    keeper_us.push_back(b.keeper_us);
    wall_ratio.push_back(b.wall_us / a.wall_us);
    thread_ratio.push_back(b.thread_us / a.thread_us);
  }
  if (plain.hash() != recorded.hash()) std::abort();
  const std::uint64_t waits = recorded.waits();
  recorded.end();
  const auto bytes = static_cast<double>(fs::file_size(file));
  fs::remove(file);
  const double robot_steps = 1000.0 * (kWarmUpSteps + kBlocks * kBlockSteps);
  return fmt::format(
      "{{\"robots\": 1000, \"period_s\": {}, {},\n  {},\n  {},\n  {},\n  {},\n"
      "  \"waits\": {}, \"file_B_per_robot_step\": {:.1f}}}",
      period_s, spread("plain_us", plain_us), spread("recorded_us", recorded_us),
      spread("keeper_thread_us", keeper_us), spread("wall_ratio", wall_ratio),
      spread("thread_ratio", thread_ratio), waits, bytes / robot_steps);
}

}  // namespace
}  // namespace rave::runtime

int main(int argc, char** argv) {
  using namespace rave;
  plugin::Catalogue catalogue(runtime::host_stamp());
  const std::string folder = argc > 1 ? argv[1] : RAVE_BENCH_PLUGINS;
  if (auto added = catalogue.add_folder(folder); !added) {
    std::fprintf(stderr, "%s\n", added.error().text().c_str());
    return 2;
  }
  std::printf("[%s,\n %s]\n", runtime::measure(catalogue, "0.01").c_str(),
              runtime::measure(catalogue, "0.1").c_str());
  return 0;
}
