// SPDX-License-Identifier: Apache-2.0
#include "rave/swarm/workload.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arena.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::swarm {
namespace {

/// Distance from a point to a rotated box; 0 inside.
double distance_m(const Box& box, double x_m, double y_m) {
  const Vec2 p_B = rotate(-deg_to_rad(box.pose.yaw_deg), {x_m - box.pose.x_m, y_m - box.pose.y_m});
  const double dx = std::max(std::abs(p_B.x) - box.length_m / 2, 0.0);
  const double dy = std::max(std::abs(p_B.y) - box.width_m / 2, 0.0);
  return std::sqrt(dx * dx + dy * dy);
}

TEST(Arena, IsAsTheWorkloadSays) {
  for (const std::uint32_t count : {1U, 2U, 5U, 200U, 1000U}) {
    const Arena arena = make_arena(count, 1);
    EXPECT_NEAR(arena.side_m, std::sqrt(10.0 * count), 1e-3);
    EXPECT_EQ(arena.robots.size(), count);
    EXPECT_EQ(arena.boxes.size(), count / 2);
    EXPECT_EQ(arena.walls.size(), 4U);
    for (const Box& box : arena.boxes) {
      EXPECT_GE(std::min(box.length_m, box.width_m), 0.4);
      EXPECT_LE(std::max(box.length_m, box.width_m), 1.0);
    }
  }
}

TEST(Arena, NobodyStandsInAnythingOrOutside) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Arena arena = make_arena(150, seed);
    for (std::size_t r = 0; r < arena.robots.size(); ++r) {
      const config::PoseFile& robot = arena.robots[r];
      for (const Box& box : arena.boxes) {
        ASSERT_GE(distance_m(box, robot.x_m, robot.y_m), kRobotRadius_m) << seed << " " << r;
      }
      for (const Box& wall : arena.walls) {
        ASSERT_GE(distance_m(wall, robot.x_m, robot.y_m), kRobotRadius_m) << seed << " " << r;
      }
      for (std::size_t other = 0; other < r; ++other) {
        const double dx = arena.robots[other].x_m - robot.x_m;
        const double dy = arena.robots[other].y_m - robot.y_m;
        ASSERT_GE(dx * dx + dy * dy, 4 * kRobotRadius_m * kRobotRadius_m) << seed << " " << r;
      }
      ASSERT_LE(std::max(std::abs(robot.x_m), std::abs(robot.y_m)), arena.side_m / 2);
    }
  }
}

TEST(Arena, WallsCloseIt) {
  const Arena arena = make_arena(37, 1);
  const double half_m = arena.side_m / 2;
  // Just inside nothing stands; from the inner face outwards a wall does, in the corners too.
  for (double along_m = -half_m; along_m <= half_m; along_m += 0.05) {
    for (const auto& [x_m, y_m] : {std::pair(along_m, half_m), std::pair(along_m, -half_m),
                                   std::pair(half_m, along_m), std::pair(-half_m, along_m)}) {
      double nearest_m = 1e9;
      for (const Box& wall : arena.walls) {
        nearest_m = std::min(nearest_m, distance_m(wall, x_m, y_m));
      }
      ASSERT_NEAR(nearest_m, 0, 1e-9) << x_m << " " << y_m;
    }
  }
  for (const Box& wall : arena.walls) {
    EXPECT_NEAR(distance_m(wall, 0, 0), half_m, 1e-9);
  }
}

TEST(Arena, ComesFromItsSeedAlone) {
  const auto places = [](std::uint64_t seed) {
    std::set<std::pair<double, double>> found;
    for (const config::PoseFile& robot : make_arena(100, seed).robots) {
      found.emplace(robot.x_m, robot.y_m);
    }
    return found;
  };
  EXPECT_EQ(places(1).size(), 100U);
  EXPECT_EQ(places(1), places(1));
  EXPECT_NE(places(1), places(2));
}

TEST(Workload, FilesSayWhatIsInMemory) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("rave_workload_" + std::to_string(::getpid()));
  for (const Sensing sensing : {Sensing::kA, Sensing::kB}) {
    for (const std::uint32_t robots : {1U, 2U, 300U}) {
      for (const Noise noise : {Noise::kNone, Noise::kGaussian}) {
        const Workload workload{sensing, robots, noise, 3, 77};
        const auto made = make_scenario(workload, 12.5);
        ASSERT_TRUE(made) << made.error().text();
        const auto written = write_scenario(workload, 12.5, folder);
        ASSERT_TRUE(written) << written.error().text();
        auto read = config::expand_scenario(folder / "scenario.yaml");
        ASSERT_TRUE(read) << read.error().text();
        // Where the robot file stands is all that differs.
        EXPECT_EQ(read->groups.at(0).file, folder / "robot.yaml");
        read->groups[0].file.clear();
        EXPECT_EQ(*read, *made) << to_string(sensing) << robots << to_string(noise);
        EXPECT_EQ(read->robots.size(), robots);
        EXPECT_EQ(read->scenario.threads, 3);
        EXPECT_EQ(read->scenario.seed, 77U);
      }
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(Workload, SensesAsItSays) {
  const auto a = make_scenario({Sensing::kA, 10, Noise::kNone, 1, 1}, 1);
  const auto b = make_scenario({Sensing::kB, 10, Noise::kGaussian, 1, 1}, 1);
  ASSERT_TRUE(a && b);
  const config::SensorFile& ring = a->groups[0].robot.sensors.at(0);
  const config::SensorFile& half = b->groups[0].robot.sensors.at(0);
  EXPECT_EQ(ring.params.find("rays")->as_int(), 16);
  EXPECT_EQ(ring.params.find("fov_deg")->as_double(), 360.0);
  EXPECT_EQ(ring.params.find("range_max_m")->as_double(), 3.0);
  EXPECT_EQ(ring.noise.length_sigma_m, 0);
  EXPECT_EQ(half.params.find("rays")->as_int(), 180);
  EXPECT_EQ(half.params.find("fov_deg")->as_double(), 180.0);
  EXPECT_EQ(half.params.find("range_max_m")->as_double(), 8.0);
  EXPECT_EQ(half.noise.length_sigma_m, kNoiseSigma_m);
  EXPECT_EQ(a->scenario.step_s.value, 0.1);
}

TEST(Workload, RefusesNoRobotsAndTooMany) {
  for (const std::uint32_t robots : {0U, kMostRobots + 1}) {
    const auto made = make_scenario({Sensing::kA, robots, Noise::kNone, 1, 1}, 1);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().message, std::to_string(robots) + " robots; expected 1 to 100000");
  }
}

}  // namespace
}  // namespace rave::swarm
