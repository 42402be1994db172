// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rave/math/scalar.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

constexpr double kSpan_s = 20;

class SensorCart : public ScenarioTest {
 protected:
  /// The newest values of a sensor of the first cart.
  static std::vector<double> values(const sim::Engine& engine, std::string_view sensor) {
    const auto sample = engine.sensor(RobotId(0), sensor_named(engine, 0, sensor));
    const auto* const first = reinterpret_cast<const double*>(sample.records);
    return {first, first + sample.header->count};
  }
  /// The hash in the result of a finished run.
  static std::string hash_in(const std::filesystem::path& folder) {
    std::ifstream file(folder / "result.json");
    return nlohmann::json::parse(file)["hash"];
  }
};

TEST_F(SensorCart, ThreadsAndProcessesDoNotMatter) {
  auto scenario = load("sensor-cart");
  scenario.scenario.duration_s = kSpan_s;
  run(scenario);
  const std::string alone = hash_in(folder_);
  std::filesystem::remove_all(folder_);
  scenario.scenario.threads = 3;
  run(scenario);
  EXPECT_EQ(hash_in(folder_), alone);

  const std::filesystem::path three = folder_ / "three";
  const std::string command = fmt::format(
      "{}/bin/rave run sensor-cart --processes 3 --quiet --duration {} --output {} > "
      "/dev/null 2>&1",
      RAVE_BINARY_DIR, kSpan_s, three.string());
  ASSERT_EQ(std::system(command.c_str()), 0);  // NOLINT(cert-env33-c)
  EXPECT_EQ(hash_in(three), alone);
}

TEST_F(SensorCart, TellsWhereItIsAndHowItIs) {
  const World world = make_world(load("sensor-cart"));
  ASSERT_TRUE(world.engine);
  const sim::Engine& engine = *world.engine;
  const Pose2 start = engine.snapshot().pose(RobotId(0));
  world.run_until(2);
  // Straight on, far from everything: 512 ticks in a turn of a wheel of 3.5 cm.
  const Pose2 now = engine.snapshot().pose(RobotId(0));
  const double ticks = (now.x - start.x) * 512 / (2 * kPi * 0.035);
  ASSERT_GT(ticks, 100);
  const auto counted = values(engine, "encoders");
  ASSERT_EQ(counted.size(), 2U);
  EXPECT_NEAR(counted[0], ticks, 40);
  EXPECT_NEAR(counted[1], ticks, 40);
  EXPECT_NEAR(values(engine, "compass").at(0), -kPi / 2, 0.06);  // East of north.
  EXPECT_NEAR(values(engine, "imu").at(6), 0, 0.05);
  EXPECT_LT(values(engine, "battery").at(0), 1);
  EXPECT_GT(values(engine, "battery").at(0), 0.99);
  EXPECT_EQ(values(engine, "gps").size(), 3U);
  // Itself, the other two, and the beacon in the middle.
  const auto ranges = values(engine, "beacons");
  ASSERT_EQ(ranges.size(), 4U);
  EXPECT_EQ(ranges[0], HUGE_VAL);
  const Pose2 other = engine.snapshot().pose(RobotId(1));
  EXPECT_NEAR(ranges[1], std::hypot(other.x - now.x, other.y - now.y), 0.1);
  EXPECT_NEAR(ranges[3], std::hypot(1.5 - now.x, -now.y), 0.1);
}

}  // namespace
}  // namespace rave::tests
