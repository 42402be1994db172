// SPDX-License-Identifier: Apache-2.0
// The plug-ins of the build tree, called as an engine calls them.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "carmen/log.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/player_testing/played.hpp"

namespace rave::carmen {
namespace {

using nlohmann::json;
using recording::Given;
using recording::kSecond_ns;
using recording::play_all;
using recording::Player;
using recording::RecordingSink;

const std::string kFolder = RAVE_SOURCE_DIR "/data/freiburg-079";
const Given kLog = {{"log", "104-224/freiburg-079.log.gz"}};
const Given kLaser = {{"log", "104-224/freiburg-079.log.gz"}, {"fov_deg", 179.5}};

Log recorded() {
  auto log = load(kFolder + "/104-224/freiburg-079.log.gz");
  EXPECT_TRUE(log);
  return log.value_or(Log{});
}

Given with(Given given, const Given& more) {
  for (const auto& [name, value] : more) given[name] = value;
  return given;
}

TEST(CarmenLaser, GivesEachScanAtItsStamp) {
  const Log log = recorded();
  const auto played = play_all<float>("carmen_laser", kLaser, kFolder);
  ASSERT_EQ(played.size(), 552U) << "551 of the window and the one that holds at its start";
  EXPECT_EQ(played[0].stamp_ns, 0);
  std::size_t scan = 0;
  while (log.scans[scan].t_ns < log.start_ns) ++scan;
  for (std::size_t i = 1; i < played.size(); ++i, ++scan) {
    ASSERT_EQ(played[i].stamp_ns, log.scans[scan].t_ns - log.start_ns);
    ASSERT_EQ(played[i].records.size(), 360U);
    const auto real = log.ranges(log.scans[scan]);
    EXPECT_TRUE(std::equal(real.begin(), real.end(), played[i].records.begin()));
  }
}

TEST(CarmenLaser, DeclaresItsRays) {
  Player player("carmen_laser");
  ASSERT_EQ(player.configure(with(kLaser, {{"range_max_m", 30.0}}), kFolder), "");
  const HardwareDeclaration& declaration = player.declaration();
  ASSERT_EQ(declaration.capacity, 360U);
  EXPECT_NEAR(declaration.bearings_rad[0], -89.75 * 3.14159265358979 / 180, 1e-9);
  EXPECT_NEAR(declaration.bearings_rad[359], 89.75 * 3.14159265358979 / 180, 1e-9);
  EXPECT_EQ(declaration.range_max_m, 30);
  EXPECT_EQ(declaration.clock, DriverClock::kStepped);
  EXPECT_EQ(declaration.collect, 0U);
}

TEST(CarmenLaser, LongRangesAreNoReturnAndShortOnesTheLeast) {
  const auto played = play_all<float>(
      "carmen_laser", with(kLaser, {{"range_min_m", 1.0}, {"range_max_m", 5.0}}), kFolder);
  int none = 0;
  for (const auto& scan : played) {
    for (const float range_m : scan.records) {
      none += std::isinf(range_m) ? 1 : 0;
      EXPECT_TRUE(range_m >= 1.0F && (range_m < 5.0F || std::isinf(range_m))) << range_m;
    }
  }
  EXPECT_GT(none, 1000);
}

const std::string kOwn = RAVE_SOURCE_DIR "/drivers/carmen/tests/logs";

json report_of(const std::string& driver, const Given& given) {
  Player player(driver);
  EXPECT_EQ(player.configure(given, kOwn), "");
  return json::parse(player.report());
}

bool noted(const json& report, const std::string& part) {
  return std::ranges::any_of(report["notes"], [&](const json& note) {
    return note.get<std::string>().find(part) != std::string::npos;
  });
}

/// Rows since 2007, with what other people's logs have: unknown messages, a stamp of another clock,
/// one out of order, a NaN, and 5.60 m for no return.
TEST(CarmenLaser, PlaysNewerRowsAndSaysWhatItMended) {
  const Given log = {{"log", "robotlaser.log"}};
  const auto scans = play_all<float>("carmen_laser", log, kOwn);
  ASSERT_EQ(scans.size(), 29U) << "of 30, one is of another clock";
  int none = 0;
  int unknown = 0;
  for (const auto& scan : scans) {
    for (const float range_m : scan.records) {
      none += std::isinf(range_m) ? 1 : 0;
      unknown += std::isnan(range_m) ? 1 : 0;
      EXPECT_FALSE(range_m >= 4.01F && !std::isinf(range_m)) << range_m;
    }
  }
  EXPECT_GT(none, 100);
  EXPECT_EQ(unknown, 1);
  Player player("carmen_laser");
  ASSERT_EQ(player.configure(log, kOwn), "");
  EXPECT_DOUBLE_EQ(player.declaration().bearings_rad[0], -1.5);
  EXPECT_DOUBLE_EQ(player.declaration().bearings_rad[60], 1.5);
  const json report = report_of("carmen_laser", log);
  EXPECT_EQ(report["message"], "ROBOTLASER1");
  EXPECT_EQ(report["passed_over"]["REMISSIONFLASER"], 3);
  EXPECT_EQ(report["passed_over"]["NMEAGGA"], 3);
  EXPECT_TRUE(noted(report,
                    "passed over rows of unknown messages: 1 x COMMENT, 3 x "
                    "REMISSIONFLASER, 3 x NMEA"))
      << report["notes"];
  EXPECT_TRUE(noted(report, "refused 1 rows, the first: ")) << report["notes"];
  EXPECT_TRUE(noted(report, "dropped 1 rows with stamps of another clock")) << report["notes"];
  EXPECT_TRUE(noted(report, "sorted 1 rows with stamps out of order")) << report["notes"];
  EXPECT_TRUE(noted(report, "1 ranges are NaN or negative")) << report["notes"];
  EXPECT_TRUE(noted(report, "have a range of exactly 5.6 m, which is taken for no return"))
      << report["notes"];
}

TEST(CarmenLaser, TheRangeOfNoReturnCanBeGiven) {
  const auto infinite = [](double no_return_m) {
    const auto scans = play_all<float>(
        "carmen_laser", {{"log", "robotlaser.log"}, {"no_return_m", no_return_m}}, kOwn);
    std::ptrdiff_t count = 0;
    for (const auto& scan : scans) {
      count +=
          std::ranges::count_if(scan.records, [](float range_m) { return std::isinf(range_m); });
    }
    return count;
  };
  EXPECT_EQ(infinite(0), 0);
  EXPECT_GT(infinite(2), infinite(-1));
}

TEST(CarmenPlayers, PlayALogOfOneStampAtAGivenRate) {
  const Given log = {{"log", "one_stamp.log"}};
  Player player("carmen_pose");
  EXPECT_NE(player.configure(log, kOwn).find("`rate_hz` gives the number of scans in a second"),
            std::string::npos);
  const auto poses = play_all<PoseReading>("carmen_pose", with(log, {{"rate_hz", 4.0}}), kOwn);
  ASSERT_EQ(poses.size(), 30U);
  EXPECT_EQ(poses[6].stamp_ns, kSecond_ns * 3 / 2);
  Player laser("carmen_laser");
  EXPECT_EQ(laser.configure(with(log, {{"rate_hz", 4.0}}), kOwn),
            "`fov_deg` is needed: FLASER rows do not say where their 61 rays point");
}

TEST(CarmenPose, OfRawScansIsThatOfTheOdometryAndTheOffset) {
  const auto raw = play_all<PoseReading>("carmen_pose", {{"log", "rawlaser.log"}}, kOwn);
  const auto merged =
      play_all<PoseReading>("carmen_pose", {{"log", "one_stamp.log"}, {"rate_hz", 5.0}}, kOwn);
  ASSERT_EQ(raw.size(), 30U);
  ASSERT_EQ(merged.size(), 30U);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    EXPECT_EQ(raw[i].stamp_ns, merged[i].stamp_ns);
    EXPECT_NEAR(raw[i].records[0].x_m, merged[i].records[0].x_m, 2e-4);
    EXPECT_NEAR(raw[i].records[0].y_m, merged[i].records[0].y_m, 2e-4);
    EXPECT_NEAR(raw[i].records[0].yaw_rad, merged[i].records[0].yaw_rad, 2e-4);
  }
}

TEST(CarmenPose, GivesThePoseOfEachScanAtItsStamp) {
  const auto scans = play_all<float>("carmen_laser", kLaser, kFolder);
  const auto poses =
      play_all<PoseReading>("carmen_pose", with(kLog, {{"position_sigma_m", 0.1}}), kFolder);
  const Log log = recorded();
  ASSERT_EQ(poses.size(), scans.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(poses[i].stamp_ns, scans[i].stamp_ns);
    EXPECT_DOUBLE_EQ(poses[i].records[0].variance_xy_m2, 0.01);
  }
  const auto later = std::ranges::upper_bound(log.scans, log.end_ns, {}, &Scan::t_ns);
  EXPECT_EQ(poses.back().records[0].x_m, (later - 1)->X_WL.x);
}

TEST(CarmenOdometry, VelocitiesAreThoseOfTheLogOrOfThePoses) {
  const auto logged = play_all<OdometryReading>("carmen_odometry", kLog, kFolder);
  const auto derived = play_all<OdometryReading>("carmen_odometry",
                                                 with(kLog, {{"velocity", "from_poses"}}), kFolder);
  ASSERT_EQ(logged.size(), derived.size());
  ASSERT_GT(logged.size(), 500U);
  double way_m = 0;
  for (std::size_t i = 0; i < logged.size(); ++i) {
    EXPECT_EQ(logged[i].records[0].v_mps, 0);
    EXPECT_LT(std::abs(derived[i].records[0].v_mps), 1.0);
    EXPECT_LT(std::abs(derived[i].records[0].w_radps), 1.8);
    if (i == 0) continue;
    const double step_s = static_cast<double>(derived[i].stamp_ns - derived[i - 1].stamp_ns) * 1e-9;
    way_m += derived[i].records[0].v_mps * step_s;
  }
  EXPECT_NEAR(way_m, 45, 6) << "the length of the track";
}

TEST(CarmenPlayers, TakeAPartOfTheStretch) {
  const auto part = play_all<PoseReading>(
      "carmen_pose", with(kLog, {{"start_s", 120.0}, {"end_s", 130.0}}), kFolder);
  ASSERT_GT(part.size(), 30U);
  EXPECT_EQ(part.front().stamp_ns, 0);
  EXPECT_LE(part.back().stamp_ns, 10 * kSecond_ns);
  Player player("carmen_pose");
  EXPECT_EQ(player.configure(with(kLog, {{"start_s", 0.0}}), kFolder),
            "the window from 0 to 224 s is empty or not within the 104 to 224 s that `" + kFolder +
                "/104-224/freiburg-079.log.gz` holds");
}

TEST(CarmenPlayers, LiveOnesFollowTheClock) {
  const auto all = play_all<PoseReading>("carmen_pose", kLog, kFolder);
  Player player("carmen_pose");
  ASSERT_EQ(player.configure(with(kLog, {{"clock", "live"}}), kFolder), "");
  EXPECT_EQ(player.declaration().clock, DriverClock::kLive);
  RecordingSink<PoseReading> sink;
  ASSERT_EQ(player.open(sink), "");
  for (std::int64_t now_ns = 0; now_ns <= 5 * kSecond_ns; now_ns += kSecond_ns / 4) {
    sink.set_now(now_ns);
    sink.await_idle();
    std::size_t due = 0;
    while (due < all.size() && all[due].stamp_ns <= now_ns) ++due;
    EXPECT_EQ(sink.published().size(), due) << now_ns;
  }
  sink.close();
  player.close();
  EXPECT_EQ(sink.fault(), "");
}

TEST(CarmenPlayers, StartOverWhenOpenedAgain) {
  Player player("carmen_pose");
  ASSERT_EQ(player.configure(kLog, kFolder), "");
  const auto first = recording::play_once<PoseReading>(player);
  const auto second = recording::play_once<PoseReading>(player);
  EXPECT_EQ(first, second);
}

TEST(CarmenPlayers, ReportWhatTheyMended) {
  Player player("carmen_odometry");
  EXPECT_EQ(player.report(), "{}");
  ASSERT_EQ(player.configure(kLog, kFolder), "");
  const auto report = nlohmann::json::parse(player.report());
  EXPECT_EQ(report["stream"], "odometry");
  EXPECT_EQ(report["file"], "freiburg-079.log.gz");
  EXPECT_EQ(report["unchanged"], true);
  EXPECT_EQ(report["beside"].dump(), "[\"stretch.txt\"]");
  EXPECT_EQ(report["beams"], 360);
  EXPECT_EQ(report["passed_over"].dump(), R"({"NEFF":560,"PARAM":187})");
  EXPECT_EQ(report["notes"].dump(), "[]") << "nothing in a good log needs a remark";
  EXPECT_EQ(report["start_s"], 104.0);
  bool junk = false;
  for (const auto& repair : report["repairs"]) junk = junk || repair["what"] == "junk_stamp";
  EXPECT_TRUE(junk);
}

TEST(CarmenPlayers, WithoutAThreadIsAnErrorAndPlayLater) {
  Player player("carmen_odometry");
  ASSERT_EQ(player.configure(kLog, kFolder), "");
  RecordingSink<OdometryReading> sink(10);
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(player.open(sink).find("cannot start the thread of the player: "), 0U);
  }
  ASSERT_EQ(player.open(sink), "");
  sink.await_blocked();
  sink.close();
  player.close();
}

TEST(CarmenPlayers, NameWhatIsNotThere) {
  Player player("carmen_laser");
  const std::string error = player.configure({{"log", "nowhere.log"}, {"fov_deg", 180.0}}, kFolder);
  EXPECT_NE(error.find("nowhere.log"), std::string::npos) << error;
}

}  // namespace
}  // namespace rave::carmen
