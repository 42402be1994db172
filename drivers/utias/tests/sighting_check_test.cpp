// SPDX-License-Identifier: Apache-2.0
// The robots' cameras are an independent witness of the captured poses: geometry alone predicts
// what they saw. Nothing of the simulator takes part.
#include <cmath>
#include <numbers>
#include <optional>

#include "recorded.hpp"

namespace rave::utias {
namespace {

struct Tally {
  int known = 0;
  int within = 0;
  [[nodiscard]] double percent() const { return 100.0 * within / std::max(known, 1); }
};

std::optional<Vec2> position_of(const Dataset& data, int subject, std::int64_t t_ns) {
  for (const Landmark& landmark : data.subjects.landmarks()) {
    if (landmark.subject == subject) return landmark.p_WL;
  }
  const RobotLog* robot = data.robot(subject);
  const auto pose = robot == nullptr ? std::nullopt : pose_at(robot->poses, t_ns);
  if (!pose) return std::nullopt;
  return pose->position();
}

bool agrees(const Sighting& sighting, const Pose2& observer, Vec2 target) {
  const Vec2 offset = target - observer.position();
  const double range_m = std::sqrt(squared_norm(offset));
  const double bearing_rad = std::atan2(offset.y, offset.x) - observer.yaw;
  const double bearing_error_rad = wrap_angle(bearing_rad - sighting.bearing_rad);
  return std::abs(range_m - sighting.range_m) < 0.5 &&
         std::abs(bearing_error_rad) < 5 * std::numbers::pi / 180;
}

Tally check(const Dataset& data) {
  Tally tally;
  for (const RobotLog& robot : data.robots) {
    for (const Sighting& sighting : robot.sightings) {
      if (sighting.subject == kUnknownSubject) continue;
      ++tally.known;
      const auto observer = pose_at(robot.poses, sighting.t_ns);
      const auto target = position_of(data, sighting.subject, sighting.t_ns);
      if (observer && target && agrees(sighting, *observer, *target)) ++tally.within;
    }
  }
  return tally;
}

TEST(SightingCheck, TheCamerasConfirmThePoses) {
  const Tally tally = check(recorded("100-220"));
  EXPECT_EQ(tally.known, 2547);
  EXPECT_NEAR(tally.percent(), 99.45, 0.1);
}

TEST(SightingCheck, TheSecondStretchIsConfirmedToo) {
  const Tally tally = check(recorded("760-900"));
  EXPECT_GT(tally.known, 1000);
  EXPECT_GT(tally.percent(), 97);
}

TEST(SightingCheck, ASlowClockIsNoticed) {
  LoadOptions options;
  for (const double offset_s : {1.0, -1.0}) {
    options.clock_offset_s = offset_s;
    EXPECT_NEAR(check(recorded("100-220", options)).percent(), 75, 2) << offset_s;
  }
  options.clock_offset_s = 0.2;
  EXPECT_NEAR(check(recorded("100-220", options)).percent(), 94.5, 0.5);
}

TEST(SightingCheck, BarcodesTakenForSubjectsAreNoticed) {
  LoadOptions options;
  options.code_meaning = CodeMeaning::kSubject;
  const Tally tally = check(recorded("100-220", options));
  EXPECT_EQ(tally.known, 866) << "a third of the rows carry a code that is also a subject's number";
  EXPECT_GT(tally.percent(), 20);
  EXPECT_LT(tally.percent(), 35);
}

}  // namespace
}  // namespace rave::utias
