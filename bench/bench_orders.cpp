// SPDX-License-Identifier: Apache-2.0
// What orders of people cost: an order to each of 1000 robots in one step, the steps with and
// without orders, and the way of a stick: from the request to the run until the actuator's driver
// has another command, in a run paced at real time with a step of 20 ms. Prints JSON.
// Usage: bench_orders [PLUGINS]
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/host/run.hpp"
#include "rave/observe/run_observer.hpp"

namespace rave::runtime {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::string_view kCrowd = R"(
name: crowd
duration_s: 1000
robots:
  - name: robot
    scatter: {count: 1000, x_m: [0, 63], y_m: [0, 63], clearance_m: 0.1}
    robot:
      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}
      sensors:
        - {name: laser, driver: virtual_laser, mount: {z_m: 0.1}, params: {rays: 16, fov_deg: 240, range_max_m: 3}}
      actuators: [{name: wheels, driver: differential_drive}]
      controllers: [{name: drive, driver: velocity, actuator: wheels}]
      program: {driver: wander}
)";

constexpr std::string_view kStick = R"(
name: stick
duration_s: 30
step_s: 0.02
pace: realtime
robots:
  - name: r1
    pose: {x_m: 0, y_m: 0}
    robot:
      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}
      actuators: [{name: wheels, driver: differential_drive}]
      controllers: [{name: drive, driver: velocity, actuator: wheels}]
)";

std::string spread(std::string_view name, std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return fmt::format(R"("{}": {{"median": {:.3f}, "p99": {:.3f}, "most": {:.3f}}})", name, at(0.5),
                     at(0.99), values.back());
}

double since_us(Clock::time_point begin) {
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

std::vector<double> steps(sim::Engine& engine, int count) {
  std::vector<double> took_us;
  for (int i = 0; i < count; ++i) {
    const auto begin = Clock::now();
    if (!engine.step()) std::abort();
    took_us.push_back(since_us(begin));
  }
  return took_us;
}

std::string measure_crowd(plugin::Catalogue& catalogue) {
  const auto scenario = config::expand_scenario_text(std::string(kCrowd), "crowd.yaml").value();
  auto built = build(scenario, catalogue, BuildOptions{}).value();
  const auto engine = sim::Engine::create(std::move(built.spec)).value();
  static_cast<void>(steps(*engine, 100));
  const auto before_us = steps(*engine, 200);
  const auto begin = Clock::now();
  for (std::uint32_t r = 0; r < 1000; ++r) {
    sim::WorldInput goal;
    goal.author.name = "anna";
    goal.robot = RobotId(r);
    goal.action = request::Order(request::Goal{{0.063 * r, 30}});
    if (!engine->order(goal)) std::abort();
  }
  const double orders_us = since_us(begin);
  const auto first_us = steps(*engine, 1);
  return fmt::format(
      "{{\"robots\": 1000, \"orders_us\": {:.1f}, \"first_step_us\": {:.1f},\n  {},\n  {}}}",
      orders_us, first_us.front(), spread("step_before_us", before_us),
      spread("step_after_us", steps(*engine, 200)));
}

/// Notes when the actuator has another command.
class ActuatorWatch final : public RunObserver {
 public:
  void after_step(const StepView& step) override {
    const double v_mps = step.engine.actuator_command(RobotId(0), 0).value[0];
    if (v_mps == v_mps_) return;
    v_mps_ = v_mps;
    changed_at.store(Clock::now());
    changes.fetch_add(1);
    changes.notify_all();
  }
  std::atomic<Clock::time_point> changed_at{};
  std::atomic<std::uint32_t> changes{0};

 private:
  double v_mps_ = 0;
};

std::string measure_stick(plugin::Catalogue& catalogue) {
  const auto scenario = config::expand_scenario_text(std::string(kStick), "stick.yaml").value();
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("rave-bench-orders-{}", ::getpid());
  RunControl control;
  ActuatorWatch watch;
  RunOptions options;
  options.output = folder;
  options.record = false;
  options.picture = false;
  options.control = &control;
  options.observers = {&watch};
  std::jthread thread([&] { static_cast<void>(run(scenario, catalogue, options)); });
  while (control.status().scenario.empty()) std::this_thread::yield();
  std::vector<double> took_ms;
  for (int i = 0; i < 500; ++i) {
    const std::uint32_t seen = watch.changes.load();
    request::Request drive{request::Drive{i % 2 == 0 ? 0.1 : 0.2, 0}, "r1", "anna"};
    const auto begin = Clock::now();
    if (!control.post(std::move(drive))) std::abort();
    watch.changes.wait(seen);
    took_ms.push_back(
        std::chrono::duration<double, std::milli>(watch.changed_at.load() - begin).count());
    // Not in step with the run.
    std::this_thread::sleep_for(std::chrono::microseconds(16'000 + i * 37 % 7000));
  }
  control.stop();
  thread.join();
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return fmt::format("{{\"step_ms\": 20, \"events\": {}, {}}}", took_ms.size(),
                     spread("to_actuator_ms", took_ms));
}

int measure(const fs::path& plugins) {
  plugin::Catalogue catalogue(host_stamp());
  if (const Status added = catalogue.add_folder(plugins); !added) {
    fmt::print(stderr, "{}\n", added.error().text());
    return 2;
  }
  fmt::print("{{\"crowd\": {},\n \"stick\": {}}}\n", measure_crowd(catalogue),
             measure_stick(catalogue));
  return 0;
}

}  // namespace
}  // namespace rave::runtime

int main(int argc, char** argv) {
  return rave::runtime::measure(argc > 1 ? argv[1] : RAVE_BENCH_PLUGINS);
}
