// SPDX-License-Identifier: Apache-2.0
// The facts known of the recording, computed once by other means from the whole data set. A reader
// that counts each file from its own first row, or loses bits of the stamps, fails here.
#include <algorithm>
#include <cmath>
#include <map>

#include "recorded.hpp"

namespace rave::utias {
namespace {

/// Distance of the centres of two robots, metres; infinite while one has no pose.
double distance_m(const Dataset& data, int a, int b, std::int64_t t_ns) {
  const auto pose_a = pose_at(data.robot(a)->poses, t_ns);
  const auto pose_b = pose_at(data.robot(b)->poses, t_ns);
  if (!pose_a || !pose_b) return std::numeric_limits<double>::infinity();
  return std::sqrt(squared_norm(pose_a->position() - pose_b->position()));
}

struct Approach {
  int a = 0;
  int b = 0;
  std::int64_t t_ns = 0;
  double distance_m = std::numeric_limits<double>::infinity();
};

Approach closest_approach(const Dataset& data) {
  Approach closest;
  for (std::int64_t t = data.start_ns; t <= data.end_ns; t += 10 * kMillisecond_ns) {
    for (int a = 1; a <= 5; ++a) {
      for (int b = a + 1; b <= 5; ++b) {
        const double distance = distance_m(data, a, b, t);
        if (distance < closest.distance_m) closest = {a, b, t, distance};
      }
    }
  }
  return closest;
}

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

TEST(RecordedFacts, TheOriginIsThatOfTheWholeDataSet) {
  for (const char* name : {"100-220", "760-900"}) {
    EXPECT_EQ(recorded(name).origin_ns, 1248444175103000000) << name;
  }
}

TEST(RecordedFacts, PosesComeAtTheirRateAndWithTwoGaps) {
  const Dataset data = recorded("100-220");
  std::map<int, std::vector<Gap>> gaps;
  for (const RobotLog& robot : data.robots) {
    const StreamReport& report = robot.pose_report;
    EXPECT_GT(report.mean_rate_hz, 59) << robot.subject;
    EXPECT_LT(report.mean_rate_hz, 70) << robot.subject;
    EXPECT_TRUE(report.repairs.empty()) << robot.subject;
    EXPECT_EQ(report.unchanged, true) << robot.subject;
    if (!report.gaps.empty()) gaps[robot.subject] = report.gaps;
    EXPECT_TRUE(pose_at(robot.poses, data.start_ns)) << robot.subject;
  }
  ASSERT_EQ(gaps.size(), 2U);
  ASSERT_EQ(gaps[1].size(), 1U);
  EXPECT_NEAR(seconds(gaps[1][0].start_ns), 192.2, 0.05);
  EXPECT_NEAR(seconds(gaps[1][0].length_ns), 0.19, 0.001);
  ASSERT_EQ(gaps[4].size(), 1U);
  EXPECT_NEAR(seconds(gaps[4][0].start_ns), 166.5, 0.05);
  EXPECT_NEAR(seconds(gaps[4][0].length_ns), 0.555, 0.001);
  EXPECT_EQ(data.robot(4)->pose_report.largest_age_ns, gaps[4][0].length_ns);
}

TEST(RecordedFacts, OdometryComesInBursts) {
  const Dataset data = recorded("100-220");
  std::int64_t largest_ns = 0;
  std::int64_t doubles = 0;
  for (const RobotLog& robot : data.robots) {
    const StreamReport& report = robot.odometry_report;
    EXPECT_GT(report.mean_rate_hz, 55) << robot.subject;
    EXPECT_LT(report.mean_rate_hz, 75) << robot.subject;
    EXPECT_TRUE(held_at(std::span<const OdometrySample>(robot.odometry), data.start_ns))
        << robot.subject;
    largest_ns = std::max(largest_ns, report.largest_gap_ns);
    doubles += report.repaired(RepairKind::kDuplicateStamp);
  }
  EXPECT_NEAR(seconds(largest_ns), 1.03, 0.001) << "robot 2 at 141.9 s";
  EXPECT_EQ(data.robot(1)->odometry_report.gaps.size(), 51U);
  EXPECT_EQ(data.robot(4)->odometry_report.gaps.size(), 26U);
  EXPECT_GT(doubles, 0) << "stamps given twice";
}

TEST(RecordedFacts, SightingsOfTheFirstStretch) {
  const Dataset data = recorded("100-220");
  std::int64_t known = 0;
  std::int64_t of_robots = 0;
  std::size_t largest_group = 0;
  std::map<int, std::int64_t> unknown;
  for (const RobotLog& robot : data.robots) {
    for (const Sighting& sighting : robot.sightings) {
      known += sighting.subject != kUnknownSubject ? 1 : 0;
      of_robots += sighting.subject >= 1 && sighting.subject <= 5 ? 1 : 0;
    }
    for (const auto& image : images_of(robot))
      largest_group = std::max(largest_group, image.size());
    for (const UnknownCode& code : robot.sighting_report.unknown_codes) {
      unknown[code.code] += code.count;
    }
    EXPECT_EQ(robot.sighting_report.stamps, static_cast<std::int64_t>(images_of(robot).size()));
  }
  EXPECT_EQ(known, 2547);
  EXPECT_EQ(unknown, (std::map<int, std::int64_t>{{50, 3}}))
      << "34 and 43 occur elsewhere in the recording";
  EXPECT_EQ(of_robots, 675) << "26.5 % here, 20.6 % in the whole recording";
  EXPECT_GE(largest_group, 6U);
  EXPECT_LE(largest_group, 10U);
}

TEST(RecordedFacts, RobotOneIsLostInTheSecondStretch) {
  const Dataset data = recorded("760-900");
  const RobotLog& robot = *data.robot(1);
  ASSERT_TRUE(robot.pose_report.last_ns);
  EXPECT_NEAR(seconds(*robot.pose_report.last_ns), 771.9, 0.05);
  ASSERT_FALSE(robot.pose_report.gaps.empty());
  EXPECT_EQ(robot.pose_report.gaps.back().kind, GapKind::kEarlyEnd);
  EXPECT_NEAR(seconds(robot.pose_report.largest_age_ns), 128.1, 0.05);
  EXPECT_EQ(robot.sighting_report.rows, 0) << "it sees nothing any more";
  // Its body is still there, still in its place, and still seen.
  const auto last = robot.poses.samples().back();
  EXPECT_EQ(pose_at(robot.poses, data.end_ns), last.pose);
  bool seen = false;
  for (const RobotLog& other : data.robots) {
    for (const Sighting& sighting : other.sightings) {
      seen = seen || (sighting.subject == 1 && sighting.t_ns > last.t_ns + kSecond_ns);
    }
    if (other.subject != 1) {
      EXPECT_NEAR(seconds(*other.pose_report.last_ns), 900, 0.02);
    }
  }
  EXPECT_TRUE(seen);
}

TEST(RecordedFacts, ClosestApproachOfTheFirstStretch) {
  const Approach closest = closest_approach(recorded("100-220"));
  EXPECT_EQ(closest.a, 4);
  EXPECT_EQ(closest.b, 5);
  EXPECT_NEAR(seconds(closest.t_ns), 117.5, 0.1);
  EXPECT_NEAR(closest.distance_m, 0.431, 0.001);
}

TEST(RecordedFacts, RobotsThreeAndFiveTouchInTheSecondStretch) {
  const Dataset data = recorded("760-900");
  const Approach closest = closest_approach(data);
  EXPECT_EQ(closest.a, 3);
  EXPECT_EQ(closest.b, 5);
  EXPECT_NEAR(seconds(closest.t_ns), 841.2, 0.1);
  EXPECT_NEAR(closest.distance_m, 0.330, 0.001);
  std::int64_t close_ns = 0;
  for (std::int64_t t = data.start_ns; t <= data.end_ns; t += 10 * kMillisecond_ns) {
    if (distance_m(data, 3, 5, t) < 0.36) close_ns += 10 * kMillisecond_ns;
  }
  EXPECT_NEAR(seconds(close_ns), 12, 1);
}

TEST(RecordedFacts, SmoothedSpeedIsThatOfTheRobot) {
  const Dataset data = recorded("100-220");
  double fastest_mps = 0;
  double fastest_raw_mps = 0;
  for (const RobotLog& robot : data.robots) {
    const auto samples = robot.poses.samples();
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const Vec2 step = samples[i].pose.position() - samples[i - 1].pose.position();
      const double dt_s = seconds(samples[i].t_ns - samples[i - 1].t_ns);
      fastest_raw_mps = std::max(fastest_raw_mps, std::sqrt(squared_norm(step)) / dt_s);
      const auto velocity = robot.poses.velocity(samples[i].t_ns);
      if (!velocity) continue;
      fastest_mps = std::max(fastest_mps, std::sqrt(squared_norm(velocity->v_WR_W)));
    }
  }
  EXPECT_GT(fastest_raw_mps, 0.2) << "what differences of neighbours would give";
  EXPECT_LT(fastest_mps, 0.13);
  EXPECT_GT(fastest_mps, 0.08);
}

TEST(RecordedFacts, ANarrowerWindowIsAllowedAndAWiderOneIsNot) {
  LoadOptions options;
  options.start_s = 150;
  options.end_s = 160;
  const Dataset data = recorded("100-220", options);
  for (const RobotLog& robot : data.robots) {
    EXPECT_LT(robot.poses.samples().front().t_ns, 149 * kSecond_ns + 20 * kMillisecond_ns);
    EXPECT_LE(robot.poses.samples().back().t_ns, 161 * kSecond_ns);
    for (const Sighting& sighting : robot.sightings) {
      EXPECT_GE(sighting.t_ns, data.start_ns);
      EXPECT_LE(sighting.t_ns, data.end_ns);
    }
  }
  options.end_s = 230;
  const auto wide = load(stretch_folder("100-220"), options);
  ASSERT_FALSE(wide);
  EXPECT_NE(wide.error().text().find("not within the 100 to 220 s"), std::string::npos)
      << wide.error().text();
}

}  // namespace
}  // namespace rave::utias
