// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fuse_drivers.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim::testing {
namespace {

constexpr std::size_t kPosePort = 0;
constexpr std::size_t kEyePort = 1;
constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kEye = 1;

/// A real robot whose pose and laser the test feeds.
RobotType fed_robot(SensorSpec eye, double live = 0) {
  RobotType type = real_type({});
  type.sensors[0] = real_sensor<HandFedPose>("mocap", {{"port", 0}, {"live", live}});
  type.sensors.push_back(std::move(eye));
  return type;
}

SensorSpec fed_laser(double rays = 1, double fov_rad = 0, double live = 0) {
  return hybrid<HandFedLaser, Laser, Nearest>(
      {{"port", 1}, {"rays", rays}, {"fov_rad", fov_rad}, {"live", live}},
      {{"rays", rays}, {"fov_rad", fov_rad}, {"range_m", 9}});
}

/// One step at t_s, with both devices saying that they are done up to it.
void step_at(Engine& engine, double t_s) {
  complete<HandFedPose>(kPosePort, t_s);
  complete<HandFedLaser>(kEyePort, t_s);
  const Status status = engine.step();
  ASSERT_TRUE(status.has_value()) << status.error().text();
}

TEST(EngineFuse, TheProgramGetsOneReadingOfBothHalves) {
  for (const bool with_box : {true, false}) {
    EngineSpec spec;
    if (with_box) spec.world.obstacles.push_back(box({1.7, 0, 0}, 1, 1));
    const RobotId robot = add_robot(spec, fed_robot(fed_laser()));
    const auto engine = make_engine(std::move(spec));
    feed_pose(kPosePort, 0, {});
    feed_ranges(kEyePort, 0, {2});
    step_at(*engine, 0);
    EXPECT_FLOAT_EQ(range(*engine, robot, kEye), with_box ? 1.2F : 2.0F);
    EXPECT_EQ(engine->sensor(robot, kEye).header->count, 1U);
    const SensorParts parts = engine->sensor_parts(robot, kEye);
    EXPECT_EQ(static_cast<const float*>(parts.real_records)[0], 2);
    EXPECT_FLOAT_EQ(static_cast<const float*>(parts.imagined_records)[0], with_box ? 1.2F : kNone);
    EXPECT_EQ(parts.bodies[0], with_box ? 0U : BodyId::kNone);
    EXPECT_EQ(parts.real->sequence, parts.imagined->sequence);
    EXPECT_EQ(engine->sensor_parts(robot, 0).real, nullptr);
  }
}

TEST(EngineFuse, RealWallsAndRealRobotsDoNotCountTwiceUnlessToldTo) {
  for (const bool all : {false, true}) {
    EngineSpec spec;
    spec.world.obstacles.push_back(box({1.7, 0, 0}, 1, 1));
    spec.world.obstacles[0].body.layer = Layer::kMappedReal;
    SensorSpec eye = fed_laser();
    if (all) eye.layers = kAllLayers;
    const RobotId robot = add_robot(spec, fed_robot(std::move(eye)));
    add_robot(spec, real_type({{"x", 0.6}}));
    const auto engine = make_engine(std::move(spec));
    feed_pose(kPosePort, 0, {});
    feed_ranges(kEyePort, 0, {2});
    step_at(*engine, 0);
    EXPECT_FLOAT_EQ(range(*engine, robot, kEye), all ? 0.45F : 2.0F);
  }
}

TEST(EngineFuse, ASimulatedRobotIsSeenWhereItWasAtTheStamp) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, fed_robot(fed_laser()));
  RobotType type = simulated_type();
  type.program = program<Drive>({{"v", 1}});
  add_robot(spec, std::move(type), {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  feed_pose(kPosePort, 0, {});
  for (int k = 0; k < 50; ++k) {
    const double t_s = 0.01 * k;
    const double stamp_s = std::max(0.0, t_s - 0.0037);  // between two steps
    feed_ranges(kEyePort, stamp_s, {5});
    step_at(*engine, t_s);
    const double expected_m = 1 + stamp_s - 0.15;
    ASSERT_NEAR(range(*engine, robot, kEye), expected_m, 1e-6) << t_s;
    ASSERT_EQ(engine->sensor(robot, kEye).header->stamp_ns, at(stamp_s).ns);
  }
}

/// Where the first and last ray that are nearer than 4 m point, in the sensor frame.
std::pair<double, double> edges_rad(const Engine& engine, RobotId robot) {
  const SensorSample sample = engine.sensor(robot, kEye);
  double low = NAN;
  double high = NAN;
  for (std::uint32_t i = 0; i < sample.header->count; ++i) {
    if (static_cast<const float*>(sample.records)[i] > 4) continue;
    const double bearing = sample.info->bearings_rad[i];
    if (std::isnan(low)) low = bearing;
    high = bearing;
  }
  return {low, high};
}

TEST(EngineFuse, OfATurningRobotTheEdgeOfABoxIsWhereItWasAtTheStampOfALateSample) {
  constexpr double kLate_s = 0.1;
  constexpr std::uint32_t kRays = 1801;
  constexpr double kHalfDegree_rad = kPi / 360;
  PlacedClock clock;
  EngineSpec spec;
  spec.live_clock = &clock;
  spec.world.obstacles.push_back(box({2, 0, 0}, 0.4, 0.4));
  const RobotId robot = add_robot(spec, fed_robot(fed_laser(kRays, kPi, 1), 1));
  const auto engine = make_engine(std::move(spec));
  const double edge_rad = atan2(0.2, 1.8);
  int seen = 0;
  for (int k = 0; k < 130; ++k) {
    const double t_s = 0.01 * k - 0.6;  // of the pose: yaw is the time since 0.6 s
    clock.time = at(0.01 * k);
    // Poses come 20 ms late, scans 100 ms; both have the stamp of when they were true.
    if (k >= 2) feed_pose(kPosePort, 0.01 * k - 0.02, {0, 0, t_s - 0.02});
    if (k >= 20) {
      feed_ranges(kEyePort, 0.01 * k - kLate_s, std::vector<float>(kRays, 5));
    }
    ASSERT_TRUE(engine->step().has_value());
    if (k < 20) continue;
    const double yaw_rad = t_s - kLate_s;
    const auto [right, left] = edges_rad(*engine, robot);
    ASSERT_NEAR(right, -edge_rad - yaw_rad, kHalfDegree_rad) << k;
    ASSERT_NEAR(left, edge_rad - yaw_rad, kHalfDegree_rad) << k;
    ++seen;
  }
  EXPECT_EQ(seen, 110);
}

TEST(EngineFuse, WhereNoPoseHasComeYetTheVelocityOfTheRobotCarriesItOn) {
  PlacedClock clock;
  EngineSpec spec;
  spec.live_clock = &clock;
  spec.world.obstacles.push_back(box({5, 0, 0}, 1, 1));
  const RobotId robot = add_robot(spec, fed_robot(fed_laser(1, 0, 1), 1));
  const auto engine = make_engine(std::move(spec));
  int withheld = 0;
  for (int k = 0; k < 200; ++k) {
    const double t_s = 0.01 * k;
    clock.time = at(t_s);
    // 0.5 m/s; poses stop at 0.5 s, scans go on.
    if (t_s <= 0.5) feed_pose(kPosePort, t_s, {0.5 * t_s, 0, 0});
    feed_ranges(kEyePort, t_s, {9});
    ASSERT_TRUE(engine->step().has_value());
    const SampleHeader& header = *engine->sensor(robot, kEye).header;
    if (t_s <= 1.0) {
      ASSERT_EQ(header.stamp_ns, at(t_s).ns);
      ASSERT_NEAR(range(*engine, robot, kEye), 4.5 - 0.5 * t_s, 1e-6) << t_s;
    } else {
      // More than the staleness limit after the last pose: what is not known is not told.
      ASSERT_EQ(header.stamp_ns, at(1.0).ns) << t_s;
      ++withheld;
    }
  }
  EXPECT_EQ(withheld, 99);
  clock.time = at(2.0);
  feed_pose(kPosePort, 2.0, {0.25, 0, 0});
  feed_ranges(kEyePort, 2.0, {9});
  ASSERT_TRUE(engine->step().has_value());
  const SampleHeader& header = *engine->sensor(robot, kEye).header;
  EXPECT_EQ(header.stamp_ns, at(2.0).ns);
  EXPECT_EQ(header.dropped, 99U);
}

TEST(EngineFuse, LatencyAndNoiseOfTheSensorComeOnceAfterFusion) {
  EngineSpec spec;
  RobotType moving = simulated_type();
  moving.program = program<Drive>({{"v", 1}});
  SensorSpec eye = fed_laser();
  eye.processing.latency_s = 0.05;
  eye.processing.noise.length_quantum_m = 0.5;
  const RobotId robot = add_robot(spec, fed_robot(std::move(eye)));
  add_robot(spec, std::move(moving), {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  feed_pose(kPosePort, 0, {});
  for (int k = 0; k < 50; ++k) {
    feed_ranges(kEyePort, 0.01 * k, {5});
    step_at(*engine, 0.01 * k);
    if (k < 5) {
      EXPECT_EQ(engine->sensor(robot, kEye).header->count, 0U);
      continue;
    }
    const double fused_m = 1 + 0.01 * (k - 5) - 0.15;
    ASSERT_EQ(engine->sensor(robot, kEye).header->stamp_ns, at(0.01 * (k - 5)).ns);
    ASSERT_EQ(range(*engine, robot, kEye), std::round(fused_m / 0.5) * 0.5) << k;
    // The halves are those of the newest sample, before that.
    const SensorParts parts = engine->sensor_parts(robot, kEye);
    ASSERT_EQ(parts.imagined->stamp_ns, at(0.01 * k).ns);
    ASSERT_NEAR(static_cast<const float*>(parts.imagined_records)[0], fused_m + 0.05, 1e-6);
  }
}

TEST(EngineFuse, EachHalfHasItsOwnNoise) {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({2.5, 0, 0}, 1, 1));
  SensorSpec eye = fed_laser();
  eye.hybrid->real_noise.length_quantum_m = 0.7;
  eye.hybrid->virtual_noise.length_sigma_m = 0.1;
  const RobotId robot = add_robot(spec, fed_robot(std::move(eye)));
  const auto engine = make_engine(std::move(spec));
  feed_pose(kPosePort, 0, {});
  double sum = 0;
  double squares = 0;
  constexpr int kSamples = 2000;
  for (int k = 0; k < kSamples; ++k) {
    if (k % 40 == 0) feed_pose(kPosePort, 0.01 * k + 1e-6, {});
    feed_ranges(kEyePort, 0.01 * k, {5});
    step_at(*engine, 0.01 * k);
    const SensorParts parts = engine->sensor_parts(robot, kEye);
    ASSERT_FLOAT_EQ(static_cast<const float*>(parts.real_records)[0], 4.9F);
    const double off = double{static_cast<const float*>(parts.imagined_records)[0]} - 2;
    sum += off;
    squares += off * off;
  }
  // Within five standard errors.
  EXPECT_NEAR(sum / kSamples, 0, 5 * 0.1 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.1, 5 * 0.1 / std::sqrt(2.0 * kSamples));
}

TEST(EngineFuse, TheVirtualBumperFeelsItsOwnLayersAlone) {
  for (const Layer layer : {Layer::kVirtualObstacles, Layer::kMappedReal}) {
    EngineSpec spec;
    spec.world.obstacles.push_back(box({0.65, 0, 0}, 1, 1));  // reaches 5 mm into the body
    spec.world.obstacles[0].X_WB.x -= 0.005;
    spec.world.obstacles[0].body.layer = layer;
    const RobotId robot = add_robot(
        spec,
        fed_robot(hybrid<HandFedBumper, Bumper, JustVirtual<ContactReading>>({{"port", 1}}, {})));
    const auto engine = make_engine(std::move(spec));
    feed_pose(kPosePort, 0, {});
    const ContactReading untouched;
    HandFedBumper::port(kEyePort)->publish({}, &untouched, 1);
    complete<HandFedBumper>(kEyePort, 0);
    complete<HandFedPose>(kPosePort, 0);
    ASSERT_TRUE(engine->step().has_value());
    const auto* const reading =
        static_cast<const ContactReading*>(engine->sensor(robot, kEye).records);
    EXPECT_EQ(reading->touching, layer == Layer::kVirtualObstacles ? 1U : 0U);
  }
}

TEST(EngineFuse, ADriverThatThrowsIsToldAndItsSensorFallsSilent) {
  EngineSpec spec;
  SensorSpec eye = fed_laser();
  eye.hybrid->params = numbers({{"throw_at", 3}});
  const RobotId robot = add_robot(spec, fed_robot(std::move(eye)));
  const auto engine = make_engine(std::move(spec));
  feed_pose(kPosePort, 0, {});
  std::vector<Event> events;
  for (int k = 0; k < 10; ++k) {
    feed_ranges(kEyePort, 0.01 * k, {5});
    step_at(*engine, 0.01 * k);
    events.insert(events.end(), engine->events().begin(), engine->events().end());
  }
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverFailed);
  EXPECT_EQ(events[0].text, "sensor `eye` (driver `fuse`): threw an exception: no rule");
  EXPECT_EQ(engine->sensor(robot, kEye).header->sequence, 2U);
}

std::string error_of(SensorSpec eye, bool as_pose_source = false) {
  EngineSpec spec;
  RobotType type = fed_robot(std::move(eye));
  if (as_pose_source) type.pose_from = kEye;
  add_robot(spec, std::move(type));
  const auto engine = Engine::create(std::move(spec));
  return engine ? "none" : engine.error().text();
}

TEST(EngineFuse, HalvesWithOtherRaysAreRefusedWithBoth) {
  EXPECT_EQ(
      error_of(hybrid<HandFedLaser, Laser, Nearest>({{"port", 1}, {"rays", 5}, {"fov_rad", 2}},
                                                    {{"rays", 4}, {"fov_rad", 2}, {"range_m", 3}})),
      "robot `r0`, sensor `eye` (driver `fuse`): the halves must have the same rays, but the "
      "real one (driver `hand_fed`) has 5 rays from -57.2958 to 57.2958 deg, the virtual one "
      "(driver `imagined`) 4 rays from -57.2958 to 57.2958 deg");
  const std::string turned = error_of(hybrid<HandFedLaser, Laser, Nearest>(
      {{"port", 1}, {"rays", 3}, {"fov_rad", 2}, {"turned_rad", 2e-6}},
      {{"rays", 3}, {"fov_rad", 2}, {"range_m", 3}}));
  EXPECT_NE(turned.find("; ray 1 points to -57.295665 and -57.295780 deg"), std::string::npos)
      << turned;
  EXPECT_EQ(error_of(hybrid<HandFedLaser, Laser, Nearest>(
                {{"port", 1}, {"rays", 3}, {"fov_rad", 2}, {"turned_rad", 5e-7}},
                {{"rays", 3}, {"fov_rad", 2}, {"range_m", 3}})),
            "none");
}

TEST(EngineFuse, APoseThatIsHalfVirtualIsNoPoseSourceOfARealRobot) {
  EXPECT_EQ(
      error_of(hybrid<HandFedPose, Beacon, JustVirtual<PoseReading>>({{"port", 1}}, {}), true),
      "robot `r0` is real, so `pose_from` needs a real sensor, but `eye` is half virtual");
}

/// Real robots with hybrid lasers in a crowd of simulated ones.
std::uint64_t hash_of(unsigned threads, bool twice = false) {
  EngineSpec spec;
  spec.threads = threads;
  spec.seed = 3;
  spec.world.obstacles.push_back(box({3, 0, 0.3}, 1, 1));
  SensorSpec eye = fed_laser(40, 3);
  eye.processing.noise.length_sigma_m = 0.02;
  eye.processing.latency_s = 0.02;
  eye.hybrid->virtual_noise.dropout_probability = 0.1;
  add_robot(spec, fed_robot(std::move(eye)));
  RobotType crowd = simulated_type();
  crowd.sensors.push_back(laser(8, 3, 2));
  crowd.program = program<Roam>();
  add_robot(spec, std::move(crowd), {0, 2, 0});
  for (int i = 1; i < 150; ++i) {
    const int row = i / 15;
    add_twin(spec, {0.5 * (i % 15), 2 + 0.5 * row, 0.1 * i});
  }
  const auto engine = make_engine(std::move(spec));
  for (int pass = 0; pass < (twice ? 2 : 1); ++pass) {
    if (pass > 0) {
      EXPECT_TRUE(engine->reset().has_value());
    }
    for (int k = 0; k < 100; ++k) {
      feed_pose(kPosePort, 0.01 * k, {0.005 * k, 0, 0.01 * k});
      if (k % 3 == 0)
        feed_ranges(kEyePort, 0.01 * k - (k > 0 ? 0.004 : 0), std::vector<float>(40, 4));
      complete<HandFedPose>(kPosePort, 0.01 * k);
      complete<HandFedLaser>(kEyePort, 0.01 * k);
      EXPECT_TRUE(engine->step().has_value());
    }
  }
  return engine->hash().value();
}

TEST(EngineFuse, TheHashIsThatOfTheReadingsWhateverTheThreads) {
  const std::uint64_t one = hash_of(1);
  EXPECT_EQ(hash_of(2), one);
  EXPECT_EQ(hash_of(3), one);
  EXPECT_EQ(hash_of(2, true), one);  // reset leads to the same run
}

TEST(EngineFuse, TheHashCoversTheFusedReading) {
  const auto with = [](double box_x_m) {
    EngineSpec spec;
    spec.world.obstacles.push_back(box({box_x_m, 0, 0}, 1, 1));
    add_robot(spec, fed_robot(fed_laser()));
    const auto engine = make_engine(std::move(spec));
    feed_pose(kPosePort, 0, {});
    feed_ranges(kEyePort, 0, {2});
    step_at(*engine, 0);
    return engine->hash().value();
  };
  EXPECT_NE(with(1.7), with(1.8));
  EXPECT_EQ(with(2.7), with(2.8));  // behind what the real half sees: the reading is the same
}

}  // namespace
}  // namespace rave::sim::testing
