// SPDX-License-Identifier: Apache-2.0
#include "carmen/log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "small_log.hpp"

namespace rave::carmen {
namespace {

using recording::RepairKind;

constexpr std::int64_t kMillisecond_ns = 1'000'000;

std::filesystem::path shipped() {
  return std::filesystem::path(RAVE_SOURCE_DIR) / "data/freiburg-079/104-224/freiburg-079.log.gz";
}

Result<Log> load_small(const LoadOptions& options = {}) {
  return load_text({small_log(), false}, "f", std::nullopt, options);
}

TEST(Log, MendsAndReportsIt) {
  const auto log = load_small();
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->origin_ns, 10'500'000'000);
  ASSERT_EQ(log->odometry.size(), 2U);
  EXPECT_EQ(log->odometry[0].t_ns, 50 * kMillisecond_ns);
  EXPECT_EQ(log->odometry_report.repaired(RepairKind::kJunkStamp), 1);
  EXPECT_EQ(log->odometry_report.repaired(RepairKind::kStepBack), 0)
      << "of the odometry alone nothing steps back";
  EXPECT_EQ(log->scan_report.repaired(RepairKind::kHeadingWrapped), 1);
  EXPECT_NEAR(log->scans[0].X_WL.yaw, 3.3 - 2 * std::numbers::pi, 1e-12);
  EXPECT_TRUE(std::isinf(log->ranges(log->scans[0])[2]));
  EXPECT_EQ(log->no_returns, 1);
  EXPECT_EQ(log->scan_report.rows, 3);
}

TEST(Log, SortsScansTogetherWithTheirRanges) {
  std::string text = altered("10.75 host 10.75\nODOM", "10.25 host 10.25\nODOM");
  const auto log = load_text({text, false}, "f", std::nullopt, {});
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->scan_report.repaired(RepairKind::kStepBack), 1);
  EXPECT_EQ(log->scans[0].t_ns, 0);
  EXPECT_EQ(log->ranges(log->scans[0])[0], 1.4F);
  EXPECT_EQ(log->ranges(log->scans[1])[0], 1.5F);
}

TEST(Log, KeepsTheLaterOfTwoScansOfOneStamp) {
  const auto log = load_text({altered("10.75 host 10.75\nODOM", "10.5 host 10.5\nODOM"), false},
                             "f", std::nullopt, {});
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->scan_report.repaired(RepairKind::kDuplicateStamp), 1);
  ASSERT_EQ(log->scans.size(), 2U);
  EXPECT_EQ(log->ranges(log->scans[0])[0], 1.4F);
}

/// A log of which all scans have the same stamp of their message.
std::string still_log(int scans, bool logger_too) {
  std::string text;
  for (int i = 0; i < scans; ++i) {
    text += fmt::format("FLASER 1 {} 0 0 0 0 0 0 12.5 nohost {}\n", 1 + i % 7,
                        logger_too ? 12.5 : 0.25 * i);
    text += fmt::format("ODOM 0 0 0 0 0 0 {:.2f} nohost {}\n", 12.5 + 0.01 * i, 0.25 * i + 0.1);
  }
  return text;
}

TEST(Log, TakesTheStampsOfTheLoggerIfThoseOfTheMessagesRepeat) {
  const auto log = load_text({still_log(2008, false), false}, "f", std::nullopt, {});
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->stamped_by, StampedBy::kLogger);
  EXPECT_EQ(log->scan_report.rows, 2008);
  EXPECT_EQ(log->scan_report.dropped(), 0);
  EXPECT_EQ(log->odometry_report.rows, 2008);
  EXPECT_EQ(log->scans[3].t_ns, 750 * kMillisecond_ns);
  EXPECT_EQ(log->odometry[3].t_ns, 850 * kMillisecond_ns);
  EXPECT_EQ(load_small()->stamped_by, StampedBy::kMessage);
}

TEST(Log, OfOneStampIsPlayedAtAGivenRate) {
  const recording::UnpackedText text{still_log(2008, true), false};
  const auto none = load_text(text, "f", std::nullopt, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(
      none.error().text(),
      "`f`: all 2008 scans have the same stamp, so their times are not known; `rate_hz` gives "
      "the number of scans in a second");
  LoadOptions options;
  options.rate_hz = 4;
  const auto log = load_text(text, "f", std::nullopt, options);
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->stamped_by, StampedBy::kRate);
  ASSERT_EQ(log->scans.size(), 2008U);
  EXPECT_EQ(log->scans[7].t_ns, 1750 * kMillisecond_ns);
  EXPECT_EQ(log->ranges(log->scans[3])[0], 4) << "in the order of the file";
  ASSERT_EQ(log->odometry.size(), 2008U);
  EXPECT_EQ(log->odometry[1].t_ns, 375 * kMillisecond_ns) << "between two scans";
  options.rate_hz = -1;
  EXPECT_EQ(load_text(text, "f", std::nullopt, options).error().text(),
            "rate_hz is -1: expected 0, or 0.001 to 1000");
}

TEST(Log, WhereOnlyTheOrderCountsNoScanIsLost) {
  LoadOptions options;
  options.order_suffices = true;
  const auto log = load_text({still_log(2008, true), false}, "f", std::nullopt, options);
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->scans.size(), 2008U);
}

TEST(Log, CountsWhatItDropsInTheWindowOnly) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const int stamped = i < 50 ? i / 2 : i;
    const double stamp_s = 0.01 * stamped;
    text += fmt::format("FLASER 1 1 0 0 0 0 0 0 {0:.2f} nohost {0:.2f}\n", stamp_s);
  }
  LoadOptions options;
  EXPECT_EQ(load_text({text, false}, "f", std::nullopt, options)->scan_report.dropped(), 25);
  options.window.start_s = 0.5;
  EXPECT_EQ(load_text({text, false}, "f", std::nullopt, options)->scan_report.dropped(), 0);
}

TEST(Log, RefusesWhatItCannotUse) {
  const auto none = load_text({"ODOM 0 0 0 0 0 0 1 h 1\n", false}, "f", std::nullopt, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().text(),
            "f: the log has no scan of the front laser (FLASER, ROBOTLASER1, RAWLASER1)");
  const auto other = load_text({"BLASER 1\nBLASER 2\nFLASER 1 x\n", false}, "f", std::nullopt, {});
  ASSERT_FALSE(other);
  EXPECT_EQ(
      other.error().text(),
      "f: the log has no scan of the front laser (FLASER, ROBOTLASER1, RAWLASER1); it has 2 x "
      "BLASER; 1 rows are refused, the first: f:3:11: FLASER: expected 12 words, found 3 words");
  LoadOptions options;
  options.window.end_s = 5;
  EXPECT_EQ(load_small(options).error().text(),
            "the window from 0 to 5 s is empty or not within the 0 to 0.5 s that `f` holds");
  options = {};
  options.range_max_m = 0;
  EXPECT_FALSE(load_small(options));
  options = {};
  options.clock_offset_s = std::nan("");
  EXPECT_FALSE(load_small(options));
}

TEST(Log, AnOffsetOfTheClockShiftsTheStamps) {
  LoadOptions options;
  options.clock_offset_s = -0.1;
  const auto log = load_small(options);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->scans[1].t_ns, 150 * kMillisecond_ns);
}

TEST(Log, TheShippedStretchIsWhatItsReadmeSays) {
  const auto log = load(shipped());
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->origin_ns, 0);
  EXPECT_EQ(log->start_ns, 104'000'000'000);
  EXPECT_EQ(log->end_ns, 224'000'000'000);
  EXPECT_EQ(log->beams, 360U);
  EXPECT_EQ(log->scan_report.rows, 551);
  EXPECT_EQ(log->scan_report.unchanged, true);
  EXPECT_NEAR(log->scan_report.mean_rate_hz, 4.6, 0.05);
  EXPECT_EQ(log->odometry_report.repaired(RepairKind::kJunkStamp), 560);
  EXPECT_LT(log->scan_report.largest_gap_ns, 1'200'000'000);
  for (const OdometrySample& sample : log->odometry) {
    EXPECT_EQ(sample.v_mps, 0) << "a corrected log has no velocities";
  }
}

/// The same points twice: a wrong direction of the beams smears a wall over more cells.
TEST(Log, TheBeamsPointWhereTheMapIsSharpest) {
  const auto log = load(shipped());
  ASSERT_TRUE(log);
  const auto cells_hit = [&](double fov_deg, double yaw_deg) {
    const auto bearings = bearings_rad(log->beams, fov_deg);
    std::set<std::pair<int, int>> cells;
    for (std::size_t k = 0; k < log->scans.size(); k += 4) {
      const Scan& scan = log->scans[k];
      const auto ranges_m = log->ranges(scan);
      for (std::size_t i = 0; i < bearings.size(); ++i) {
        if (!(ranges_m[i] < 8)) continue;
        const double angle = scan.X_WL.yaw + bearings[i] + yaw_deg * std::numbers::pi / 180;
        const auto range_m = static_cast<double>(ranges_m[i]);
        cells.emplace(
            static_cast<int>(std::floor((scan.X_WL.x + range_m * std::cos(angle)) / 0.05)),
            static_cast<int>(std::floor((scan.X_WL.y + range_m * std::sin(angle)) / 0.05)));
      }
    }
    return cells.size();
  };
  const std::size_t best = cells_hit(179.5, -0.25);
  EXPECT_LT(best, cells_hit(179.5, -1.25));
  EXPECT_LT(best, cells_hit(179.5, 0.75));
  EXPECT_LT(best, cells_hit(182, -0.25));
  EXPECT_LT(best, cells_hit(177, -0.25));
}

TEST(Bearings, AreSpreadAsThoseOfTheVirtualLaser) {
  const auto bearings = bearings_rad(5, 180);
  EXPECT_NEAR(bearings[0], -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(bearings[2], 0);
  EXPECT_NEAR(bearings[4], std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(bearings_rad(4, 360)[1], -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(bearings_rad(1, 90)[0], 0);
}

}  // namespace
}  // namespace rave::carmen
