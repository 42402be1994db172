// SPDX-License-Identifier: Apache-2.0
// What a program gets of a real and a virtual half.
#include <cmath>
#include <cstring>

#include "hybrid_fixture.hpp"
#include "rave/math/scalar.hpp"

namespace rave::tests {
namespace {

using Halves = HybridTest;

TEST_F(Halves, OfALaserTheNearerOneCounts) {
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()), box_at(1.2))).at(0), 1.2F);
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()))).at(0), 2.0F);
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()), box_at(2.5))).at(0), 2.0F);
  EXPECT_EQ(first_ranges(scenario(robot(laser("", "range_m: 9")))).at(0), kNoReturn);
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser("", "range_m: 9")), box_at(2.5))).at(0), 2.5F);
}

std::string sonar(const std::string& params = "") {
  return "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, real: {driver: still_ranges, "
         "params: {cone_deg: 30}}, virtual: {driver: virtual_sonar, params: {cone_deg: 30, " +
         params + "}}}";
}
/// A small box off the axis of the sonar: the nearest corner of it at 10 degrees and 1.2 m.
std::string box_aside() {
  const double x_m = 1.2 * std::cos(deg_to_rad(10.0));
  const double y_m = 1.2 * std::sin(deg_to_rad(10.0));
  return "obstacles: [{name: box, box_m: [0.1, 0.1], x_m: " + std::to_string(x_m + 0.05) +
         ", y_m: " + std::to_string(y_m + 0.05) + ", z_m: [0, 1]}]\n";
}

TEST_F(Halves, OfASonarTheNearestInTheConeCountsNotWhatIsOnTheAxis) {
  EXPECT_NEAR(first_ranges(scenario(robot(sonar()), box_aside())).at(0), 1.2, 1e-3);
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(sonar()))).at(0), 2.0F);
  // A narrow cone, or too short a reach: the model of the virtual half decides what it reads.
  const auto narrow = scenario(robot("{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, real: "
                                     "{driver: still_ranges}, virtual: "
                                     "{driver: virtual_sonar, params: {cone_deg: 10}}}"),
                               box_aside());
  EXPECT_FLOAT_EQ(first_ranges(narrow).at(0), 2.0F);
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(sonar("range_max_m: 1")), box_aside())).at(0), 2.0F);
  // A least range, and a coarse resolution that leaves three rays, which all miss the corner.
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(sonar("range_min_m: 1.5")), box_aside())).at(0),
                  1.5F);
  EXPECT_GT(first_ranges(scenario(robot(sonar("resolution_deg: 15")), box_aside())).at(0), 1.9F);
}

TEST_F(Halves, WallsThatExistAndRealRobotsAreLeftToTheRealHalf) {
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()), box_at(1.2, "mapped_real"))).at(0), 2.0F);
  const std::string all = laser("", "", ", senses: [mapped_real]");
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(all), box_at(1.2, "mapped_real"))).at(0), 1.2F);
  const std::string bert = "  - name: bert\n    robot: " + robot(laser(), "x_m: 1") + "\n";
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()), "", bert)).at(0), 2.0F);
}

TEST_F(Halves, ASimulatedRobotStandsInTheReadingOfARealOne) {
  const std::string carl =
      "  - {name: carl, pose: {x_m: 1, y_m: 0}, robot: {body: {shapes: [{disc_radius_m: 0.15, z_m: "
      "[0, 0.3]}]}, actuators: [{name: wheels, driver: differential_drive}], controllers: [{name: "
      "drive, driver: velocity, actuator: wheels}]}}\n";
  EXPECT_FLOAT_EQ(first_ranges(scenario(robot(laser()), "", carl)).at(0), 0.85F);
}

TEST_F(Halves, OcclusionFollowsTheModelOfTheRealSensor) {
  const auto read = [&](const std::string& params, const std::string& real, double box_m) {
    return first_ranges(scenario(robot(laser("rule: occlusion, " + params, real)), box_at(box_m)))
        .at(0);
  };
  EXPECT_FLOAT_EQ(read("", "", 1.2), 1.2F);
  EXPECT_FLOAT_EQ(read("", "", 2.2), 2.0F);
  EXPECT_EQ(read("", "range_m: 9, range_max_m: 4", 4.5), kNoReturn);  // out of its reach
  EXPECT_FLOAT_EQ(read("", "range_m: 9, range_max_m: 5", 4.5), 4.5F);
  EXPECT_FLOAT_EQ(read("", "range_min_m: 0.5", 0.3), 0.5F);
  EXPECT_EQ(read("too_near: no_return", "range_min_m: 0.5", 0.3), kNoReturn);
  EXPECT_TRUE(std::isnan(read("too_near: invalid", "range_min_m: 0.5", 0.3)));
  EXPECT_FLOAT_EQ(read("", "range_min_m: 0.5, range_m: 0.1", 1), 0.1F);  // a real error code stays
}

TEST_F(Halves, TheRaysOfTheRealHalfCanBeThoseOfBoth) {
  const std::string eye =
      "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, real: {driver: still_ranges, params: "
      "{rays: 7, fov_deg: 60, start_deg: 25}}, virtual: {driver: virtual_laser, params: "
      "{rays_of_real_half: true}}}";
  const std::string wall =
      "obstacles: [{name: wall, box_m: [0.2, 20], x_m: 1.1, y_m: 0, z_m: [0, "
      "1]}]\n";
  const auto read = first_ranges(scenario(robot(eye), wall));
  ASSERT_EQ(read.size(), 7U);
  for (int i = 0; i < 7; ++i) {
    const double expected = std::min(2.0, 1 / std::cos(deg_to_rad(-5.0 + 10 * i)));
    EXPECT_NEAR(read[static_cast<std::size_t>(i)], expected, 1e-6) << i;
  }
}

TEST_F(Halves, ABumperTouchesIfEitherDoes) {
  const auto touches = [&](bool real, double box_m, const std::string& layer) {
    const std::string bumper =
        "{name: bumper, driver: hybrid_contact, real: {driver: still_contact, params: {touching: " +
        std::string(real ? "true" : "false") + "}}, virtual: {driver: virtual_contact}}";
    const auto engine = engine_of(scenario(robot(bumper), box_at(box_m, layer)));
    if (!engine) return false;
    steps(*engine, 1);
    const auto* reading = static_cast<const ContactReading*>(engine->sensor(RobotId(0), 1).records);
    EXPECT_EQ(engine->sensor(RobotId(0), 1).header->count, 1U);
    return reading->touching != 0;
  };
  EXPECT_FALSE(touches(false, 1, "virtual_obstacles"));
  EXPECT_TRUE(touches(true, 1, "virtual_obstacles"));
  EXPECT_TRUE(touches(false, 0.1495, "virtual_obstacles"));
  EXPECT_FALSE(touches(false, 0.1495, "mapped_real"));  // that wall is for the real bumper to feel
}

TEST_F(Halves, PosesAreWeightedByTheirVariances) {
  const std::string gps =
      "{name: gps, driver: hybrid_pose, real: {driver: turning_pose, params: {x_m: 0.3, yaw_deg: "
      "178, sigma_xy_m: 0.3, sigma_yaw_deg: 2, period_s: 0.01}}, virtual: {driver: "
      "indoor_positioning, params: {sigma_xy_m: 0.4, sigma_yaw_deg: 4}}}";
  const auto engine = engine_of(scenario(robot(gps, "yaw_deg: -178")));
  ASSERT_TRUE(engine);
  // The real half stands 0.3 m and -4 degrees off; the virtual one scatters about the truth.
  double x = 0;
  double xx = 0;
  double turn = 0;
  constexpr int kSamples = 4000;
  for (int k = 0; k < kSamples; ++k) {
    steps(*engine, 1);
    const auto* pose = static_cast<const PoseReading*>(engine->sensor(RobotId(0), 1).records);
    x += pose->x_m;
    xx += pose->x_m * pose->x_m;
    turn += wrap_angle(pose->yaw_rad - deg_to_rad(178.0));
    ASSERT_NEAR(pose->variance_xy_m2, 1 / (1 / 0.09 + 1 / 0.16), 1e-12);
    ASSERT_NEAR(pose->variance_yaw_rad2, deg_to_rad(1.0) * deg_to_rad(1.0) / (1.0 / 4 + 1.0 / 16),
                1e-12);
  }
  const double mean = x / kSamples;
  const double sigma = std::sqrt(xx / kSamples - mean * mean);
  // share of the virtual half: 0.09 / (0.09 + 0.16); five standard errors either way
  EXPECT_NEAR(mean, 0.3 * (1 - 0.36), 5 * 0.36 * 0.4 / std::sqrt(kSamples));
  EXPECT_NEAR(sigma, 0.36 * 0.4, 5 * 0.36 * 0.4 / std::sqrt(2.0 * kSamples));
  EXPECT_NEAR(turn / kSamples, deg_to_rad(4.0) * 0.2,
              5 * deg_to_rad(4.0) * 0.2 / std::sqrt(kSamples));
}

TEST_F(Halves, APoseWithoutVarianceIsRefusedNotGuessed) {
  const std::string gps =
      "{name: gps, driver: hybrid_pose, real: {driver: turning_pose, params: {sigma_xy_m: 0}}, "
      "virtual: {driver: indoor_positioning}}";
  const auto engine = engine_of(scenario(robot(gps)));
  ASSERT_TRUE(engine);
  steps(*engine, 1);
  ASSERT_EQ(engine->events().size(), 1U);
  EXPECT_EQ(engine->events()[0].text,
            "sensor `gps` (driver `hybrid_pose`): threw an exception: a reading of the real half "
            "has the variance 0, so it cannot be weighted: expected `real_sigma_xy_m` above 0 in "
            "the parameters");
}

/// The rays of the box's edges must be those of the stamps, which lie between the steps.
TEST_F(Halves, TheEdgeOfABoxIsWhereATurningRobotSawIt) {
  const std::string eye =
      "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, latency_s: 0.1, real: {driver: "
      "still_ranges, params: {rays: 1801, fov_deg: 180, range_m: 5, first_s: 0.0513}}, virtual: "
      "{driver: virtual_laser, params: {rays: 1801}}}";
  const auto engine = engine_of(scenario(
      robot(eye, "turn_radps: 1, yaw_deg: -50, period_s: 0.02"),
      "obstacles: [{name: box, box_m: [0.4, 0.4], x_m: 2, y_m: 0, z_m: [0, 1]}]\n", "", "0.1"));
  ASSERT_TRUE(engine);
  const double* bearings_rad = engine->sensor(RobotId(0), 1).info->bearings_rad;
  const double edge_rad = std::atan2(0.2, 1.8);
  int seen = 0;
  for (int k = 0; k < 15; ++k) {
    steps(*engine, 1);
    const auto read = ranges(*engine);
    if (read.empty()) continue;
    ++seen;
    const auto first = std::find_if(read.begin(), read.end(), [](float r) { return r < 4; });
    ASSERT_NE(first, read.end());
    const double right_rad = bearings_rad[first - read.begin()];
    const double stamp_s =
        static_cast<double>(engine->sensor(RobotId(0), 1).header->stamp_ns) * 1e-9;
    const double yaw_rad = deg_to_rad(-50.0) + stamp_s;
    EXPECT_NEAR(rad_to_deg(right_rad), rad_to_deg(-edge_rad - yaw_rad), 0.5);
  }
  EXPECT_EQ(seen, 13);
}

}  // namespace
}  // namespace rave::tests
