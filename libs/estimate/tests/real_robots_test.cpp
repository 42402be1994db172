// SPDX-License-Identifier: Apache-2.0
// The five robots of the data set "UTIAS Multi-Robot Cooperative Localization and Mapping", number
// 6 (K. Leung et al., IJRR 2011), led by one who knows their commands, sightings and first poses.
// The whole log does not ship: the test is skipped where no folder above the working one has it.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "rave/estimate/team_filter.hpp"
#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kRobots = 5;
constexpr double kStart_s = 1248444175.103;  // Unix time of the first poses.
constexpr double kJudgeFrom_s = 15;          // All robots have commands and sightings from here on.
using Row = std::vector<double>;

fs::path data_folder() {
  for (fs::path folder = fs::current_path();; folder = folder.parent_path()) {
    if (fs::path data = folder / "shared/data/mrclam6"; fs::exists(data)) return data;
    if (folder == folder.parent_path()) return {};
  }
}

std::vector<Row> rows_of(const fs::path& folder, const std::string& name) {
  std::vector<Row> rows;
  const gzFile file = gzopen((folder / (name + ".dat.gz")).c_str(), "rb");
  if (file == nullptr) return rows;
  std::array<char, 512> line{};
  while (gzgets(file, line.data(), static_cast<int>(line.size())) != nullptr) {
    if (line[0] == '#') continue;
    Row row;
    char* end = line.data();
    for (const char* at = nullptr; at != end;) {
      at = end;
      const double value = std::strtod(at, &end);
      if (at != end) row.push_back(value);
    }
    if (!row.empty()) rows.push_back(row);
  }
  gzclose(file);
  return rows;
}

struct Event {
  enum Kind { kCommand, kSighting, kPose } kind{};
  double time_s = 0;
  std::size_t robot = 0;
  Row row;
};

struct Log {
  std::vector<Event> events;  ///< Of all robots, in the order of time.
  std::array<Pose2, kRobots> first;
  std::map<int, int> subject_of_code;
  std::map<int, Vec2> landmarks_W;
};

Log read_log(const fs::path& folder) {
  Log log;
  for (const Row& row : rows_of(folder, "Barcodes"))
    log.subject_of_code[static_cast<int>(row[1])] = static_cast<int>(row[0]);
  for (const Row& row : rows_of(folder, "Landmark_Groundtruth"))
    log.landmarks_W[static_cast<int>(row[0])] = {row[1], row[2]};
  for (std::size_t robot = 0; robot < kRobots; ++robot) {
    const std::string name = "Robot" + std::to_string(robot + 1);
    for (const Row& row : rows_of(folder, name + "_Odometry"))
      log.events.push_back({Event::kCommand, row[0] - kStart_s, robot, row});
    for (const Row& row : rows_of(folder, name + "_Measurement"))
      log.events.push_back({Event::kSighting, row[0] - kStart_s, robot, row});
    const std::vector<Row> poses = rows_of(folder, name + "_Groundtruth");
    log.first[robot] = {poses[0][1], poses[0][2], poses[0][3]};
    double judged_s = kJudgeFrom_s;
    for (const Row& row : poses) {
      const double time_s = row[0] - kStart_s;
      if (time_s < judged_s) continue;
      judged_s = time_s + 0.1;
      log.events.push_back({Event::kPose, time_s, robot, row});
    }
  }
  std::stable_sort(log.events.begin(), log.events.end(),
                   [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
  return log;
}

/// A mean of squares.
struct Square {
  double sum = 0;
  int count = 0;
  void add(double squared) {
    sum += squared;
    ++count;
  }
  [[nodiscard]] double root() const { return std::sqrt(sum / count); }
};

struct Figures {
  std::array<Square, kRobots> filtered;
  std::array<Square, kRobots> odometry;
  Square all;
  Square near;          ///< Within a second of a sighting, believed or not, metres.
  Square near_heading;  ///< And radians.
};

/// Whether it named a landmark or a robot.
bool see(TeamFilter& team, const Log& log, const Event& event) {
  const auto subject = log.subject_of_code.find(static_cast<int>(event.row[1]));
  if (subject == log.subject_of_code.end()) return false;
  if (const auto at = log.landmarks_W.find(subject->second); at != log.landmarks_W.end()) {
    team.see_landmark(event.robot, event.time_s, at->second, event.row[2], event.row[3]);
  } else {
    team.see_robot(event.robot, static_cast<std::size_t>(subject->second) - 1, event.time_s,
                   event.row[2], event.row[3]);
  }
  return true;
}

Figures lead(const Log& log) {
  TeamFilter team({}, {});
  // The commands as they are, integrated.
  TeamFilter odometry({.delay_s = 0, .turning_share = 1}, {});
  for (const Pose2& first : log.first) {
    team.add(first, 0.02, 0.02, 0);
    odometry.add(first, 0.02, 0.02, 0);
  }
  Figures figures;
  std::array<double, kRobots> sighted_s{};
  for (const Event& event : log.events) {
    if (event.kind == Event::kCommand) {
      team.command(event.robot, event.time_s, event.row[1], event.row[2]);
      odometry.command(event.robot, event.time_s, event.row[1], event.row[2]);
    } else if (event.kind == Event::kSighting) {
      if (see(team, log, event)) sighted_s[event.robot] = event.time_s;
    } else {
      const Vec2 p_W{event.row[1], event.row[2]};
      team.advance(event.robot, event.time_s);
      odometry.advance(event.robot, event.time_s);
      const Pose2 X_WR = team.filter(event.robot).pose();
      const double squared = squared_norm(X_WR.position() - p_W);
      figures.filtered[event.robot].add(squared);
      figures.all.add(squared);
      figures.odometry[event.robot].add(
          squared_norm(odometry.filter(event.robot).pose().position() - p_W));
      if (event.time_s - sighted_s[event.robot] > 1) continue;
      figures.near.add(squared);
      const double turned_rad = std::remainder(X_WR.yaw - event.row[3], 2 * kPi);
      figures.near_heading.add(turned_rad * turned_rad);
    }
  }
  return figures;
}

TEST(RealRobots, ALeaderKnowsWhereItsRobotsAre) {
  const fs::path folder = data_folder();
  if (folder.empty()) GTEST_SKIP() << "there is no folder shared/data/mrclam6 here or above";
  const Log log = read_log(folder);
  ASSERT_GT(log.events.size(), 100'000U);
  const Figures figures = lead(log);
  for (std::size_t robot = 0; robot < kRobots; ++robot) {
    const double filtered_m = figures.filtered[robot].root();
    const double odometry_m = figures.odometry[robot].root();
    std::printf("robot %zu: %.3f m, odometry %.2f m\n", robot + 1, filtered_m, odometry_m);
    EXPECT_LE(filtered_m, 0.30) << robot + 1;
    EXPECT_GE(odometry_m, 6 * filtered_m) << robot + 1;
  }
  std::printf("all: %.3f m; within 1 s of a sighting: %.3f m, %.2f degrees\n", figures.all.root(),
              figures.near.root(), figures.near_heading.root() * 180 / kPi);
  EXPECT_LE(figures.all.root(), 0.25);
  EXPECT_LE(figures.near.root(), 0.18);
  EXPECT_LE(figures.near_heading.root() * 180 / kPi, 3.0);
}

}  // namespace
}  // namespace rave::estimate
