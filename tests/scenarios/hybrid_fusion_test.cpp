// SPDX-License-Identifier: Apache-2.0
// What the hybrid laser of the scenario `hybrid-laser` makes of real scans, over the whole run.
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "carmen/log.hpp"
#include "rave/math/transform.hpp"
#include "ray_geometry.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

constexpr double kRangeMax_m = 30;
constexpr double kTolerance_m = 1e-3;

/// What was seen of the fused scans.
struct Tally {
  int scans = 0;
  std::uint64_t rays = 0;
  std::uint64_t kept = 0;         ///< Fused is real, to the bit.
  std::uint64_t by_box = 0;       ///< Shortened by a virtual obstacle.
  std::uint64_t by_robot = 0;     ///< Shortened by a simulated robot.
  std::uint64_t longer = 0;       ///< Fused is longer than real: never.
  std::uint64_t through_box = 0;  ///< A box is in the way and the fused ray goes on: never.
};

/// As pages write it: groups of three digits from five digits on.
std::string grouped(std::uint64_t number) {
  if (number < 10'000) return std::to_string(number);
  return fmt::format("{} {:03}", number / 1000, number % 1000);
}

class HybridFusion : public ScenarioTest {
 protected:
  void start() {
    carmen::LoadOptions options;
    options.range_max_m = kRangeMax_m;
    auto log = carmen::load(
        std::filesystem::path(RAVE_SOURCE_DIR) / "data/freiburg-079/104-224/freiburg-079.log.gz",
        options);
    ASSERT_TRUE(log) << log.error().text();
    log_ = *std::move(log);
    for (const carmen::Scan& scan : log_.scans) scans_[scan.t_ns - log_.start_ns] = &scan;
    world_ = make_world(load("hybrid-laser"));
    ASSERT_TRUE(world_.engine);
    robot_ = robot_named(engine(), "freiburg");
    laser_ = sensor_named(engine(), robot_, "laser");
    const auto& obstacles = engine().spec().world.obstacles;
    for (std::uint32_t b = 0; b < obstacles.size(); ++b) {
      if (obstacles[b].body.layer == Layer::kVirtualObstacles) boxes_.push_back(b);
    }
    ASSERT_EQ(boxes_.size(), 3U);
  }

  [[nodiscard]] sim::Engine& engine() const { return *world_.engine; }

  [[nodiscard]] double geometry(std::uint32_t body, SimTime stamp, Vec2 p_W, double yaw_rad) const {
    const auto& world = engine().spec().world;
    const auto first_robot = static_cast<std::uint32_t>(world.obstacles.size());
    const Pose2 X_WB = body < first_robot
                           ? world.obstacles[body].X_WB
                           : engine().pose_at(RobotId(body - first_robot), stamp).value_or(Pose2{});
    return ray_to_body(world, body, X_WB, p_W, yaw_rad);
  }

  /// The newest fused scan, if it has not been seen before.
  void check_scan() {
    const sim::SensorSample fused = engine().sensor(RobotId(robot_), laser_);
    if (fused.header->sequence == 0 || fused.header->sequence == sequence_) return;
    sequence_ = fused.header->sequence;
    const sim::SensorParts parts = engine().sensor_parts(RobotId(robot_), laser_);
    ASSERT_NE(parts.real, nullptr);
    ASSERT_EQ(parts.real->stamp_ns, fused.header->stamp_ns);
    ASSERT_EQ(parts.imagined->stamp_ns, fused.header->stamp_ns) << "evaluated at the real stamp";
    ASSERT_EQ(fused.header->count, log_.beams);
    ASSERT_EQ(parts.real->count, log_.beams);
    const auto* real_m = static_cast<const float*>(parts.real_records);
    if (fused.header->stamp_ns > 0) {
      const auto logged = scans_.find(fused.header->stamp_ns);
      ASSERT_NE(logged, scans_.end()) << fused.header->stamp_ns;
      EXPECT_EQ(std::memcmp(log_.ranges(*logged->second).data(), real_m, 4UL * log_.beams), 0);
    }
    const SimTime stamp{fused.header->stamp_ns};
    const auto X_WR = engine().pose_at(RobotId(robot_), stamp);
    ASSERT_TRUE(X_WR) << X_WR.error().text();
    const Pose2 X_WS = compose(*X_WR, fused.info->X_RS);
    const auto* fused_m = static_cast<const float*>(fused.records);
    for (std::uint32_t i = 0; i < log_.beams; ++i) {
      check_ray(real_m[i], fused_m[i], parts.bodies[i], stamp, X_WS.position(),
                X_WS.yaw + fused.info->bearings_rad[i]);
    }
    ++tally_.scans;
  }

  void check_ray(float real_m, float fused_m, std::uint32_t body, SimTime stamp, Vec2 p_W,
                 double yaw_rad) {
    ++tally_.rays;
    if (fused_m > real_m) ++tally_.longer;
    for (const std::uint32_t box : boxes_) {
      const double box_m = geometry(box, stamp, p_W, yaw_rad);
      if (box_m <= kRangeMax_m && static_cast<double>(fused_m) > box_m + kTolerance_m) {
        // A ray that grazes a corner may pass it.
        grazing_ += 1;
        tally_.through_box += geometry(box, stamp, p_W, yaw_rad + 1e-5) <= kRangeMax_m &&
                                      geometry(box, stamp, p_W, yaw_rad - 1e-5) <= kRangeMax_m
                                  ? 1U
                                  : 0U;
      }
    }
    if (std::bit_cast<std::uint32_t>(fused_m) == std::bit_cast<std::uint32_t>(real_m)) {
      ++tally_.kept;
      return;
    }
    ASSERT_NE(body, BodyId::kNone);
    const auto& world = engine().spec().world;
    const Layer layer = world.body(body).layer;
    ASSERT_TRUE(layer == Layer::kVirtualObstacles || layer == Layer::kSimulatedRobots);
    EXPECT_NEAR(static_cast<double>(fused_m), geometry(body, stamp, p_W, yaw_rad), kTolerance_m);
    ++(layer == Layer::kVirtualObstacles ? tally_.by_box : tally_.by_robot);
  }

  carmen::Log log_;
  std::map<std::int64_t, const carmen::Scan*> scans_;
  World world_;
  std::uint32_t robot_ = 0;
  std::uint32_t laser_ = 0;
  std::uint32_t sequence_ = 0;
  std::vector<std::uint32_t> boxes_;
  int grazing_ = 0;
  Tally tally_;
};

TEST_F(HybridFusion, VirtualThingsShortenRealRaysAsGeometrySays) {
  ASSERT_NO_FATAL_FAILURE(start());
  while (engine().time().seconds() < 119.99) {
    const Status status = engine().step();
    ASSERT_TRUE(status) << status.error().text();
    ASSERT_NO_FATAL_FAILURE(check_scan());
  }
  std::printf("%d scans, %llu rays: %llu kept, %llu shortened by boxes, %llu by robots\n",
              tally_.scans, static_cast<unsigned long long>(tally_.rays),
              static_cast<unsigned long long>(tally_.kept),
              static_cast<unsigned long long>(tally_.by_box),
              static_cast<unsigned long long>(tally_.by_robot));
  EXPECT_GE(tally_.scans, 545);
  EXPECT_EQ(tally_.longer, 0U);
  EXPECT_EQ(tally_.through_box, 0U);
  EXPECT_GT(tally_.by_box, 3000U);
  EXPECT_GT(tally_.by_robot, 500U);
  EXPECT_EQ(tally_.kept + tally_.by_box + tally_.by_robot, tally_.rays);
  expect_on_page("hybrid-laser",
                 fmt::format("{} and {} of {}, in {} scans", grouped(tally_.by_box),
                             grouped(tally_.by_robot), grouped(tally_.rays), tally_.scans));
  expect_on_page("hybrid-laser",
                 fmt::format("the real range, to the bit ({})", grouped(tally_.kept)));
}

}  // namespace
}  // namespace rave::tests
