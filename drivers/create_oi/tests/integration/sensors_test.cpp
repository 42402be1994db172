// SPDX-License-Identifier: Apache-2.0
#include "create_bench.hpp"

namespace rave::oi {
namespace {

constexpr double kPi = 3.14159265358979;

/// Drives straight into the wall at x = 6 with a heading; what the bumper says.
ContactReading bump(const std::string& yaw) {
  CreateBench bench({"--pose", "5.5,1.5," + yaw});
  bench.start();
  if (::testing::Test::HasFatalFailure()) return {};
  bench.touches->await_more(1);
  EXPECT_EQ(bench.touches->samples().back().records.front().touching, 0U);
  bench.keep_driving(0.2, 0);
  const ContactReading contact =
      bench.touches->await_record([](const ContactReading& r) { return r.touching != 0; });
  bench.stop_driving();
  const auto now = bench.await_standstill();
  EXPECT_EQ(now["touches"], 1);
  EXPECT_NEAR(now["x"].get<double>(), 6 - 0.174, 2e-3) << "it is stopped by the wall";
  // Away from it again.
  bench.keep_driving(-0.2, 0);
  bench.touches->await_record([](const ContactReading& r) { return r.touching == 0; });
  return contact;
}

TEST(CreateSensors, TheBumperTellsTheSide) {
  EXPECT_NEAR(bump("0").bearing_rad, 0, 1e-6);
  EXPECT_NEAR(bump("0.6").bearing_rad, -kPi / 4, 1e-6) << "looking left, it touches on the right";
  EXPECT_NEAR(bump("-0.6").bearing_rad, kPi / 4, 1e-6);
}

TEST(CreateSensors, CliffsAndWheelDrops) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.cliffs->await_more(1);
  EXPECT_EQ(bench.cliffs->samples().back().records, (std::vector<double>{0, 0, 0, 0, 0, 0}));
  bench.peer->tell("cliff 8");
  bench.peer->tell("drop 2");
  bench.await_state([](const nlohmann::json& s) { return s["mode"] == "passive"; });
  bench.cliffs->await_more(3);
  EXPECT_EQ(bench.cliffs->samples().back().records, (std::vector<double>{0, 0, 0, 1, 1, 0}));
}

TEST(CreateSensors, TheBattery) {
  CreateBench bench({"--battery-mah", "1348"});
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.charges->await_more(2);
  const std::vector<double> values = bench.charges->samples().back().records;
  ASSERT_EQ(values.size(), 6U);
  EXPECT_NEAR(values[0], 0.5, 0.01);
  EXPECT_NEAR(values[1], 14.75, 0.05);
  EXPECT_LT(values[2], -0.2);
  EXPECT_NEAR(values[3], 1.348, 0.01);
  EXPECT_NEAR(values[4], 2.696, 1e-9);
  EXPECT_EQ(values[5], 27);
}

TEST(CreateSensors, TheVelocityIsThatOfTheWheels) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  bench.keep_driving(0.2, 0.5);
  bench.poses->await_record([](const OdometryReading& r) {
    return std::abs(r.v_mps - 0.2) < 0.01 && std::abs(r.w_radps - 0.5) < 0.08;
  });
  bench.stop_driving();
  bench.await_standstill();
  bench.poses->await_record(
      [](const OdometryReading& r) { return r.v_mps == 0 && r.w_radps == 0; });
}

TEST(CreateSensors, FramesCarryOnlyWhatIsAskedFor) {
  CreateBench bench;
  testing::LiveDevice slow(bench.plugin, "create_oi");
  bench.given["baud"] = 19200.0;
  ASSERT_EQ(slow.configure(bench.given), "");
  ASSERT_EQ(bench.odometry.configure({}, slow.base()), "");
  EXPECT_EQ(slow.open(), "") << "21 bytes in 15 ms";
  slow.close();
  ASSERT_EQ(bench.battery.configure({}, slow.base()), "");
  EXPECT_EQ(slow.open(),
            "19200 baud carry a frame of these sensors in 19.3 ms, but one comes each 15 ms: use a "
            "higher `baud` or fewer sensors");
}

TEST(CreateSensors, AbsenceAtTheStartIsAnError) {
  CreateBench bench;
  bench.given["device"] = "/nowhere/robot";
  bench.given["start_timeout_s"] = 0.2;
  ASSERT_EQ(bench.device.configure(bench.given), "");
  EXPECT_EQ(bench.device.open(),
            "no robot with the Open Interface answered at `/nowhere/robot` within 0.2 s: cannot "
            "open `/nowhere/robot`: No such file or directory");
  EXPECT_EQ(bench.device.report()["connected"], false);
}

}  // namespace
}  // namespace rave::oi
