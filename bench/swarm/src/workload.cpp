// SPDX-License-Identifier: Apache-2.0
#include "rave/swarm/workload.hpp"

#include <fmt/format.h>

#include <array>
#include <iterator>

#include "arena.hpp"
#include "rave/base/file.hpp"
#include "rave/config/robot_file.hpp"

namespace rave::swarm {
namespace {

constexpr std::string_view kLicence = "# SPDX-License-Identifier: Apache-2.0\n";

/// Both the scenario in memory and the one in files come from here.
std::string robot_text(const Workload& workload) {
  const bool ring = workload.sensing == Sensing::kA;
  const double sigma_m = workload.noise == Noise::kGaussian ? kNoiseSigma_m : 0;
  return fmt::format(R"({}description: A robot of the benchmark `rave bench swarm`, workload {}
body:
  shapes:
    - {{disc_radius_m: {}, z_m: [0, 0.3]}}
  mass_kg: 2
sensors:
  - name: laser
    driver: virtual_laser
    mount: {{z_m: 0.2}}
    period_s: {}
    params: {{rays: {}, fov_deg: {}, range_max_m: {}}}
    noise: {{length_sigma_m: {}}}
actuators:
  - name: wheels
    driver: differential_drive
    params: {{wheel_separation_m: 0.26, max_wheel_speed_mps: 0.6}}
controllers:
  - {{name: drive, driver: velocity, actuator: wheels}}
program:
  driver: cruise
  period_s: {}
)",
                     kLicence, to_string(workload.sensing), kRobotRadius_m, kStep_s,
                     rays_of(workload.sensing), ring ? 360 : 180, range_max_m(workload.sensing),
                     sigma_m, kStep_s);
}

config::ObstacleFile obstacle(std::string name, const Box& box) {
  config::ObstacleFile file;
  file.name = std::move(name);
  file.outline.box_m = std::array<double, 2>{box.length_m, box.width_m};
  file.x_m = box.pose.x_m;
  file.y_m = box.pose.y_m;
  file.yaw_deg = box.pose.yaw_deg;
  return file;
}

std::vector<config::ObstacleFile> obstacles_of(const Arena& arena) {
  std::vector<config::ObstacleFile> files;
  files.reserve(arena.walls.size() + arena.boxes.size());
  for (const Box& wall : arena.walls) {
    files.push_back(obstacle(fmt::format("wall-{}", files.size() + 1), wall));
  }
  for (std::size_t b = 0; b < arena.boxes.size(); ++b) {
    files.push_back(obstacle(fmt::format("box-{}", b + 1), arena.boxes[b]));
  }
  return files;
}

std::string world_text(const Arena& arena) {
  std::string text = fmt::format("{}description: The arena of a benchmark\nobstacles:\n", kLicence);
  for (const config::ObstacleFile& file : obstacles_of(arena)) {
    const auto& [x_m, y_m] = *file.outline.box_m;
    fmt::format_to(std::back_inserter(text),
                   "  - {{name: {}, box_m: [{}, {}], x_m: {}, y_m: {}, yaw_deg: {}}}\n",
                   file.name.value, x_m, y_m, file.x_m, file.y_m, file.yaw_deg);
  }
  return text;
}

/// All of the scenario but obstacles and robots.
config::ScenarioFile settings(const Workload& workload, double duration_s) {
  config::ScenarioFile file;
  file.name = fmt::format("swarm-{}-{}", to_string(workload.sensing), workload.robots);
  file.description = "Workload of `rave bench swarm`";
  file.seed = workload.seed;
  file.duration_s = duration_s;
  file.step_s = kStep_s;
  file.threads = workload.threads;
  return file;
}

std::string scenario_text(const Workload& workload, double duration_s, const Arena& arena) {
  const config::ScenarioFile file = settings(workload, duration_s);
  std::string text = fmt::format(
      "{}name: {}\ndescription: {}\nworld: world.yaml\nduration_s: {}\nstep_s: {}\nseed: {}\n"
      "threads: {}\npace: max\nrobots:\n  - name: robot\n    file: robot.yaml\n    poses:\n",
      kLicence, file.name.value, file.description, duration_s, file.step_s.value, file.seed,
      file.threads);
  for (const config::PoseFile& pose : arena.robots) {
    fmt::format_to(std::back_inserter(text), "      - [{}, {}, {}]\n", pose.x_m, pose.y_m,
                   pose.yaw_deg);
  }
  return text;
}

Status check(const Workload& workload) {
  if (workload.robots >= 1 && workload.robots <= kMostRobots) return {};
  return fail(ErrorCode::kInvalidArgument, "{} robots; expected 1 to {}", workload.robots,
              kMostRobots);
}

}  // namespace

std::string_view to_string(Sensing sensing) noexcept { return sensing == Sensing::kA ? "A" : "B"; }

std::string_view to_string(Noise noise) noexcept {
  return noise == Noise::kGaussian ? "gaussian" : "none";
}

std::uint32_t rays_of(Sensing sensing) noexcept { return sensing == Sensing::kA ? 16 : 180; }

double range_max_m(Sensing sensing) noexcept { return sensing == Sensing::kA ? 3 : 8; }

Result<config::ExpandedScenario> make_scenario(const Workload& workload, double duration_s) {
  RAVE_TRY(check(workload));
  const Arena arena = make_arena(workload.robots, workload.seed);
  config::ScenarioFile file = settings(workload, duration_s);
  file.obstacles = obstacles_of(arena);
  config::RobotEntry& entry = file.robots.emplace_back();
  entry.name = std::string("robot");
  RAVE_TRY_ASSIGN(entry.robot, config::read_robot_text(robot_text(workload), "robot.yaml"));
  auto& poses = entry.poses.emplace();
  poses.reserve(arena.robots.size());
  for (const config::PoseFile& pose : arena.robots) {
    poses.push_back({pose.x_m, pose.y_m, pose.yaw_deg});
  }
  return config::expand_scenario_file(std::move(file), "scenario.yaml");
}

Status write_scenario(const Workload& workload, double duration_s,
                      const std::filesystem::path& folder) {
  RAVE_TRY(check(workload));
  RAVE_TRY(create_folder(folder));
  const Arena arena = make_arena(workload.robots, workload.seed);
  RAVE_TRY(write_file_atomically(folder / "robot.yaml", robot_text(workload)));
  RAVE_TRY(write_file_atomically(folder / "world.yaml", world_text(arena)));
  return write_file_atomically(folder / "scenario.yaml",
                               scenario_text(workload, duration_s, arena));
}

}  // namespace rave::swarm
