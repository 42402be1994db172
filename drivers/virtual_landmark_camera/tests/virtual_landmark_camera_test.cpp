// SPDX-License-Identifier: Apache-2.0
#include "rave/driver_testing/fake_world.hpp"
#include "rave/driver_testing/sensor_under_test.hpp"

namespace rave::testing {
namespace {

Vec2 polar(double range_m, double bearing_deg) {
  const SinCos direction = sincos(deg_to_rad(bearing_deg));
  return range_m * Vec2{direction.cos, direction.sin};
}

/// A robot at the origin that looks along x, and tubes with codes on their upper half.
class VirtualLandmarkCamera : public ::testing::Test {
 protected:
  BodyId add_tube(Vec2 p_W, std::int32_t code) {
    const BodyId tube = world.add_disc(p_W, 0.06, Layer::kMappedReal);
    world.add_code(tube, code, 0.5, 1.0);
    return tube;
  }
  std::vector<std::int32_t> codes(SensorUnderTest& camera, double z_m = 0.75) {
    std::vector<std::int32_t> result;
    for (const Sighting& sighting :
         camera.sample<Sighting>(world, looking_from(robot, {0, 0, 0}, z_m))) {
      result.push_back(sighting.code);
    }
    return result;
  }

  FakeWorld world;
  RobotId robot = world.add_robot({0, 0, 0}, 0.17);
};

using Codes = std::vector<std::int32_t>;

TEST_F(VirtualLandmarkCamera, MeasuresToTheAxis) {
  world.set_time({1234567890123});
  add_tube({5, 4}, 63);
  SensorUnderTest camera;
  ASSERT_TRUE(camera.configured) << camera.error();
  EXPECT_EQ(camera.declaration.capacity, 32U);
  SampleItem item = looking_from(robot, {1, 1, 0.5}, 0.75);
  item.X_WS = {2, 1, 0.6};  // the tube is at (3, 3) from here
  const auto seen = camera.sample<Sighting>(world, item);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].stamp_ns, 1234567890123);
  EXPECT_EQ(seen[0].code, 63);
  EXPECT_NEAR(seen[0].range_m, std::sqrt(18.0), 1e-6);
  EXPECT_NEAR(seen[0].bearing_rad, kPi / 4 - 0.6, 1e-6);
}

TEST_F(VirtualLandmarkCamera, FieldIsAsymmetric) {
  add_tube(polar(3, -33.99), 1);
  add_tube(polar(4, -34.01), 2);
  add_tube(polar(3, 32.99), 3);
  add_tube(polar(4, 33.01), 4);
  add_tube(polar(3, 180), 5);
  SensorUnderTest camera({{"fov_min_deg", -34}, {"fov_max_deg", 33}, {"occlusion", 0}});
  EXPECT_EQ(codes(camera), (Codes{1, 3}));
  SensorUnderTest sliver({{"fov_min_deg", -34.02}, {"fov_max_deg", -34}, {"occlusion", 0}});
  EXPECT_EQ(codes(sliver), (Codes{2}));
  SensorUnderTest all({{"fov_min_deg", -180}, {"fov_max_deg", 180}, {"occlusion", 0}});
  EXPECT_EQ(codes(all), (Codes{1, 2, 3, 4, 5}));
}

TEST_F(VirtualLandmarkCamera, RangeCountsToTheAxis) {
  add_tube({0.99, 0}, 1);
  add_tube(polar(1.01, 20), 2);
  add_tube(polar(4.99, -20), 3);
  add_tube(polar(5.01, 10), 4);
  SensorUnderTest camera({{"range_min_m", 1}, {"range_max_m", 5}});
  EXPECT_EQ(codes(camera), (Codes{2, 3}));
}

TEST_F(VirtualLandmarkCamera, BodiesHideCodes) {
  add_tube({6, 0}, 1);
  const BodyId box = world.add_box({3, 0.09, 0}, {0.1, 0.1});
  SensorUnderTest camera;
  EXPECT_EQ(codes(camera), Codes{});
  SensorUnderTest ghost({{"occlusion", 0}});
  EXPECT_EQ(codes(ghost), (Codes{1}));
  // The line to the axis counts: half a tube in sight is not enough, half and a bit is.
  world.at(box).X_WB.y = 0.11;
  EXPECT_EQ(codes(camera), (Codes{1}));
}

TEST_F(VirtualLandmarkCamera, NeitherTubeNorOwnBodyHidesTheCode) {
  add_tube({2, 0}, 1);
  add_tube({4, 0}, 2);  // behind the first
  SensorUnderTest camera;
  EXPECT_EQ(codes(camera), (Codes{1}));
}

TEST_F(VirtualLandmarkCamera, LooksAtTheHeightOfTheCode) {
  add_tube({6, 0}, 1);
  const BodyId box = world.add_box({3, 0, 0}, {0.1, 0.1});
  SensorUnderTest camera;
  // From 0.2 m the line is lifted to the lower edge of the code, 0.5 m.
  world.at(box).z1_m = 0.45;
  EXPECT_EQ(codes(camera, 0.2), (Codes{1}));
  world.at(box).z1_m = 0.55;
  EXPECT_EQ(codes(camera, 0.2), Codes{});
  // From 2 m it is lowered to the upper edge, 1 m.
  EXPECT_EQ(codes(camera, 2.0), (Codes{1}));
  world.at(box).z1_m = 1.05;
  EXPECT_EQ(codes(camera, 2.0), Codes{});
}

TEST_F(VirtualLandmarkCamera, LayersAreRespected) {
  add_tube({6, 0}, 1);
  world.add_box({3, 0, 0}, {0.1, 0.1}, Layer::kVirtualObstacles);
  // A camera that does not see virtual obstacles looks through them.
  SensorUnderTest real_only({}, static_cast<LayerMask>(Layer::kMappedReal));
  EXPECT_EQ(codes(real_only), (Codes{1}));
  // One that does not see the tubes does not read them.
  SensorUnderTest virtual_only({}, kUnrealLayers);
  EXPECT_EQ(codes(virtual_only), Codes{});
}

TEST_F(VirtualLandmarkCamera, ReadsOtherRobotsInLandmarkOrderAndNeverItself) {
  const RobotId other = world.add_robot({4, 1, 0}, 0.17, Layer::kRealRobots);
  world.add_code(world.body_of(robot), 5, 0, 1);
  world.add_code(world.body_of(other), 14, 0, 1);
  add_tube({2, 0.2}, 7);
  SensorUnderTest camera({{"range_min_m", 0}});
  EXPECT_EQ(codes(camera), (Codes{14, 7}));
}

TEST_F(VirtualLandmarkCamera, StopsWhenFull) {
  for (int i = 0; i < 5; ++i) add_tube(polar(3, 10.0 * i - 20), i);
  SensorUnderTest camera({{"max_sightings", 3}});
  EXPECT_EQ(codes(camera), (Codes{0, 1, 2}));
}

TEST_F(VirtualLandmarkCamera, RefusesContradictions) {
  const SensorUnderTest range({{"range_min_m", 9}});
  EXPECT_EQ(range.error(),
            "`range_min_m` is 9 and must be smaller than `range_max_m`, which is 8.7");
  const SensorUnderTest field({{"fov_min_deg", 40}});
  EXPECT_FALSE(field.configured);
  EXPECT_EQ(field.error(),
            "`fov_min_deg` is 40 and must be smaller than `fov_max_deg`, which is 33");
}

}  // namespace
}  // namespace rave::testing
