// SPDX-License-Identifier: Apache-2.0
// A run without files: the scenario is a text, the robot program a class of this file, and the loop
// over the steps your own. It finds the highest speed at which a robot still stops before a wall.
#include <fmt/format.h>

#include <algorithm>
#include <rave/assemble/build.hpp>
#include <rave/robot/program.hpp>
#include <rave/robot/scan.hpp>
#include <rave/sim/engine.hpp>

namespace {

constexpr std::string_view kScenario = R"(
name: braking
duration_s: 60
obstacles:
  - {name: wall, box_m: [0.2, 4], x_m: 4, z_m: [0, 0.5]}
robots:
  - name: racer
    pose: {x_m: 0, y_m: 0}
    robot:
      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.2]}]}
      sensors: [{name: sonar, driver: virtual_sonar, period_s: 0.1, mount: {z_m: 0.1}, params: {range_max_m: 2}}]
      actuators: [{name: wheels, driver: differential_drive, params: {max_wheel_speed_mps: 5}}]
      controllers: [{name: drive, driver: velocity, actuator: wheels, params: {max_speed_mps: 5}}]
)";

double speed_mps = 0;  // Of the next run.

/// Drives straight ahead until something is near, then slows down by 0.1 m/s in each decision.
class Racer : public rave::DecisionProcess {
 public:
  rave::Status start(const rave::Setup& setup) override {
    scan_ = rave::Scan(setup);
    RAVE_TRY_ASSIGN(drive_, setup.controller(rave::CommandKind::kVelocity));
    return {};
  }
  void decide(const rave::Percepts& percepts, rave::Commands& commands) override {
    scan_.update(percepts);
    if (scan_.nearest_m(-0.3, 0.3) < 1.5) brakes_mps_ += 0.1;
    commands.velocity(drive_, std::max(0.0, speed_mps - brakes_mps_), 0);
  }

 private:
  rave::Scan scan_;
  rave::ControllerHandle drive_;
  double brakes_mps_ = 0;  // What it has taken off its speed so far.
};

/// Whether the robot comes to rest without a touch; prints where.
rave::Result<bool> stops_in_time(rave::plugin::Catalogue& catalogue) {
  static constexpr rave::ProgramOps kRacer = rave::detail::program_ops<Racer>();
  RAVE_TRY_ASSIGN(const auto scenario, rave::config::expand_scenario_text(kScenario, "braking"));
  RAVE_TRY_ASSIGN(auto built, rave::runtime::build(scenario, catalogue, {}));
  // What no file can say: the program is in this process, and it decides every tenth step.
  rave::sim::ProgramSpec& program = built.spec.types[0].program.emplace();
  program.driver = "racer";
  program.ops = &kRacer;
  program.period_steps = 10;

  RAVE_TRY_ASSIGN(const auto engine, rave::sim::Engine::create(std::move(built.spec)));
  const rave::RobotId racer(0);
  bool touched = false;
  bool moved = false;
  bool rests = false;
  while (!touched && !rests && engine->steps_done() < 6000) {
    RAVE_TRY(engine->step());
    for (const rave::sim::Event& event : engine->events()) {
      touched = touched || event.kind == rave::sim::EventKind::kContact;
    }
    const double v_mps = engine->snapshot().robot(racer).velocity_W.vx;
    moved = moved || v_mps > 0.1;
    rests = moved && v_mps == 0;
  }
  fmt::print("{:.2f} m/s: {} at x = {:.2f} m after {} steps\n", speed_mps,
             touched ? "touches the wall" : "stops", engine->true_pose(racer).x,
             engine->steps_done());
  return rests && !touched;
}

rave::Status find_highest_speed() {
  rave::plugin::Catalogue catalogue(rave::runtime::host_stamp());
  RAVE_TRY(catalogue.add_folder(PLUGIN_DIR));
  double good_mps = 0;
  double bad_mps = 3;
  while (bad_mps - good_mps > 0.05) {
    speed_mps = (good_mps + bad_mps) / 2;
    RAVE_TRY_ASSIGN(const bool good, stops_in_time(catalogue));
    (good ? good_mps : bad_mps) = speed_mps;
  }
  fmt::print("highest speed: {:.2f} m/s\n", good_mps);
  return {};
}

}  // namespace

int main() {
  const rave::Status status = find_highest_speed();
  if (status) return 0;
  fmt::print(stderr, "{}\n", status.error().text());
  return 1;
}
