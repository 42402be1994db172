// SPDX-License-Identifier: Apache-2.0
// A program of its own: it counts every allocation of the process.
#include "counted_allocations.hpp"
#include "fuse_drivers.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineFuse, AStepWithAHybridSensorAllocatesNothing) {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({2, 0, 0}, 1, 1));
  RobotType type = real_type({});
  type.sensors[0] = real_sensor<HandFedPose>("mocap", {{"port", 0}});
  SensorSpec eye =
      hybrid<HandFedLaser, Laser, Nearest>({{"port", 1}, {"rays", 100}, {"fov_rad", 2}},
                                           {{"rays", 100}, {"fov_rad", 2}, {"range_m", 5}});
  eye.processing.latency_s = 0.02;
  eye.hybrid->virtual_noise.length_sigma_m = 0.01;
  type.sensors.push_back(std::move(eye));
  add_robot(spec, std::move(type));
  add_robot(spec, simulated_type(), {1, 1, 0});
  const auto engine = make_engine(std::move(spec));
  const std::vector<float> ranges(100, 4);
  std::uint64_t late = 0;
  for (int k = 0; k < 600; ++k) {
    feed_pose(0, 0.01 * k, {0.001 * k, 0, 0});
    feed_ranges(1, 0.01 * k, ranges);
    complete<HandFedPose>(0, 0.01 * k);
    complete<HandFedLaser>(1, 0.01 * k);
    const std::uint64_t before = allocations.load();
    const bool stepped = engine->step().has_value();
    // The first seconds fill what is kept: the history, the track of the robot.
    if (k >= 400) late += allocations.load() - before;
    ASSERT_TRUE(stepped);
  }
  EXPECT_EQ(engine->sensor(RobotId(0), 1).header->sequence, 598U);
  EXPECT_EQ(late, 0U);
}

}  // namespace
}  // namespace rave::sim::testing
