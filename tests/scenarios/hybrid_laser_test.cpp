// SPDX-License-Identifier: Apache-2.0
// The recorded robot of the scenario `hybrid-laser`: that its map predicts its real scans, and what
// fusion makes of them.
#include <algorithm>
#include <cmath>
#include <vector>

#include "carmen/log.hpp"
#include "rave/math/transform.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

constexpr double kLaserRange_m = 30;

carmen::Log shipped_log() {
  carmen::LoadOptions options;
  options.range_max_m = kLaserRange_m;
  auto log = carmen::load(
      std::filesystem::path(RAVE_SOURCE_DIR) / "data/freiburg-079/104-224/freiburg-079.log.gz",
      options);
  EXPECT_TRUE(log) << (log ? "" : log.error().text());
  return log.value_or(carmen::Log{});
}

/// How far predicted ranges are from real ones.
struct Errors {
  std::vector<double> off_m;
  std::size_t rays = 0;

  void take(std::span<const float> real, std::span<const float> predicted) {
    for (std::size_t i = 0; i < real.size(); ++i) {
      if (!std::isfinite(real[i])) continue;
      ++rays;
      // A ray that the map lets pass is as wrong as can be.
      off_m.push_back(std::abs(static_cast<double>(predicted[i]) - static_cast<double>(real[i])));
    }
  }
  double quantile_m(double share) {
    const auto at =
        off_m.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(off_m.size() - 1));
    std::nth_element(off_m.begin(), at, off_m.end());
    return *at;
  }
};

class HybridLaser : public ScenarioTest {
 protected:
  /// Gives the recorded robot a virtual laser that sees the map and nothing else.
  static void add_twin(config::ExpandedScenario& scenario) {
    for (config::RobotGroup& group : scenario.groups) {
      for (const config::SensorFile& laser : group.robot.sensors) {
        if (laser.name.value != "laser" || !laser.imagined) continue;
        config::SensorFile twin;
        twin.name = std::string("laser_twin");
        twin.driver = std::string("virtual_laser");
        twin.mount = laser.mount;
        twin.period_s = codec::Located<double>(0.2);
        twin.senses = std::vector{config::SensedLayer::kMappedReal};
        twin.params = laser.imagined->params;
        twin.params.set("rays", codec::RawNode::number(360));
        twin.params.set("fov_deg", codec::RawNode::number(179.5));
        group.robot.sensors.push_back(twin);
        return;
      }
    }
    ADD_FAILURE() << "no robot has a hybrid laser";
  }

  /// The scans of the log against the virtual laser in the map, at the stamps and poses of the log.
  /// `late_ns`: how much later than the scan the prediction is made, to show that it matters.
  void predict(Errors& errors, std::int64_t late_ns = 0) {
    const carmen::Log log = shipped_log();
    auto scenario = load("hybrid-laser");
    add_twin(scenario);
    auto world = make_world(scenario);
    ASSERT_TRUE(world.engine);
    sim::Engine& engine = *world.engine;
    const std::uint32_t robot = robot_named(engine, "freiburg");
    const std::uint32_t twin = sensor_named(engine, robot, "laser_twin");
    std::vector<float> predicted(log.beams);
    for (const carmen::Scan& scan : log.scans) {
      if (scan.t_ns < log.start_ns + 1'000'000'000 || scan.t_ns > log.end_ns - 1'000'000'000)
        continue;
      const SimTime stamp{scan.t_ns - log.start_ns};
      world.run_until(stamp.seconds() + 0.6);
      const auto header =
          engine.sample_at(RobotId(robot), twin, stamp + Duration{late_ns}, predicted.data());
      ASSERT_TRUE(header) << header.error().text();
      ASSERT_EQ(header->count, log.beams);
      if (late_ns == 0) {
        const auto X_WR = engine.pose_at(RobotId(robot), stamp);
        ASSERT_TRUE(X_WR);
        EXPECT_NEAR(X_WR->x, scan.X_WL.x, 1e-6);
        EXPECT_NEAR(X_WR->y, scan.X_WL.y, 1e-6);
      }
      errors.take(log.ranges(scan), predicted);
    }
  }
};

TEST_F(HybridLaser, TheMapPredictsTheRealScans) {
  Errors errors;
  predict(errors);
  ASSERT_GT(errors.rays, 180'000U);
  const double median_m = errors.quantile_m(0.5);
  const double q90_m = errors.quantile_m(0.9);
  std::printf("predicted against real ranges: %zu rays, median %.3f m, 90 %% within %.3f m\n",
              errors.rays, median_m, q90_m);
  EXPECT_LT(median_m, 0.06);
  EXPECT_LT(q90_m, 0.7);
  expect_on_page("hybrid-laser",
                 fmt::format("median {:.3f} m, 90 % within {:.2f} m", median_m, q90_m));
}

TEST_F(HybridLaser, PredictionsForAnotherInstantAreWorse) {
  Errors errors;
  predict(errors, 500'000'000);
  std::printf("half a second late: median %.3f m, 90 %% within %.3f m\n", errors.quantile_m(0.5),
              errors.quantile_m(0.9));
  EXPECT_GT(errors.quantile_m(0.5), 0.15);
}

}  // namespace
}  // namespace rave::tests
