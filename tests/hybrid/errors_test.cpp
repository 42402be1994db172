// SPDX-License-Identifier: Apache-2.0
// Robot files with hybrid sensors that cannot be.
#include "hybrid_fixture.hpp"

namespace rave::tests {
namespace {

using HybridErrors = HybridTest;

TEST_F(HybridErrors, HalvesOfAnotherKindAreNamedAtTheirPlace) {
  const std::string virtual_half = error_of(scenario(
      robot("{name: eye, driver: hybrid_ranges, real: {driver: still_ranges}, virtual: {driver: "
            "virtual_contact}}")));
  EXPECT_EQ(virtual_half.find("s.yaml:6:"), 0U) << virtual_half;
  EXPECT_NE(virtual_half.find("sensor `eye`: the driver `hybrid_ranges` fuses ranges, but its "
                              "virtual half (driver `virtual_contact`) gives contact"),
            std::string::npos)
      << virtual_half;
  const std::string real_half = error_of(scenario(
      robot("{name: eye, driver: hybrid_contact, real: {driver: still_ranges}, virtual: {driver: "
            "virtual_contact}}")));
  EXPECT_NE(real_half.find("its real half (driver `still_ranges`) gives ranges"), std::string::npos)
      << real_half;
}

TEST_F(HybridErrors, AVirtualDriverIsNoRealHalfAndTheOtherWayRound) {
  const std::string error = error_of(scenario(
      robot("{name: eye, driver: hybrid_ranges, real: {driver: virtual_laser}, virtual: {driver: "
            "virtual_laser}}")));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("`virtual_laser`"), std::string::npos) << error;
}

TEST_F(HybridErrors, ADriverThatFusesNeedsBothHalves) {
  const std::string error = error_of(scenario(robot("{name: eye, driver: hybrid_ranges}")));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("the driver `hybrid_ranges` of sensor `eye` fuses two halves: expected "
                       "`real:` and `virtual:`"),
            std::string::npos)
      << error;
}

TEST_F(HybridErrors, OtherRaysAreShownBothWays) {
  const std::string count = error_of(scenario(
      robot("{name: eye, driver: hybrid_ranges, real: {driver: still_ranges, params: {rays: "
            "3, fov_deg: 90}}, virtual: {driver: virtual_laser, params: {rays: 5, fov_deg: "
            "90}}}")));
  EXPECT_NE(count.find("robot `anna`, sensor `eye` (driver `hybrid_ranges`): the halves must have "
                       "the same rays, but the real one (driver `still_ranges`) has 3 rays from "
                       "-45.0000 to 45.0000 deg, the virtual one (driver `virtual_laser`) 5 rays "
                       "from -45.0000 to 45.0000 deg"),
            std::string::npos)
      << count;
  const std::string direction = error_of(scenario(robot(laser("", "start_deg: 0.001"))));
  EXPECT_NE(direction.find("; ray 1 points to 0.001000 and 0.000000 deg"), std::string::npos)
      << direction;
}

TEST_F(HybridErrors, AHybridPoseIsNotWhereARealRobotIs) {
  const std::string error = error_of(scenario(
      "{body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 1]}]}, pose_from: gps, actuators: [{name: "
      "wheels, "
      "driver: "
      "replay_ignored}], sensors: [{name: gps, driver: hybrid_pose, real: {driver: turning_pose}, "
      "virtual: {driver: indoor_positioning}}]}"));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(
      error.find("robot `anna` is real, so `pose_from` needs a real sensor, but `gps` (driver "
                 "`hybrid_pose`) is a hybrid"),
      std::string::npos)
      << error;
}

TEST_F(HybridErrors, ParametersOfEachHalfAreCheckedAtTheirPlace) {
  const std::string error = error_of(scenario(robot(laser("", "rayz: 3"))));
  EXPECT_EQ(error.find("s.yaml:6:"), 0U) << error;
  EXPECT_NE(error.find("`rayz`"), std::string::npos) << error;
  const std::string rule = error_of(scenario(robot(laser("rule: nearer"))));
  EXPECT_EQ(rule.find("s.yaml:6:"), 0U) << rule;
  EXPECT_NE(rule.find("nearest"), std::string::npos) << rule;
  const std::string wrong = error_of(scenario(
      robot("{name: eye, driver: hybrid_ranges, real: {driver: still_ranges}, virtual: {driver: "
            "virtual_laser, params: {rays: 1, range_min_m: 9}}}")));
  EXPECT_NE(wrong.find("sensor `eye` (driver `hybrid_ranges`): virtual half (driver "
                       "`virtual_laser`): `range_min_m` is 9"),
            std::string::npos)
      << wrong;
}

}  // namespace
}  // namespace rave::tests
