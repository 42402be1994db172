// SPDX-License-Identifier: Apache-2.0
// Logs whose stamps are not all good: few rows are lost, and those are counted.
#include "carmen/stamps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "carmen/log.hpp"
#include "carmen/notes.hpp"

namespace rave::carmen {
namespace {

using recording::RepairKind;

/// 100 scans in 10 s with odometry between, each stamped by the function.
std::string log_of(const std::function<std::string(int)>& scan_stamp,
                   const std::function<std::string(int)>& odometry_stamp) {
  std::string text;
  for (int i = 0; i < 100; ++i) {
    text += fmt::format("FLASER 2 1.5 2.{0} {0} 0 0 {0} 0 0 {1} host {2:.2f}\n", i, scan_stamp(i),
                        0.1 * i);
    text += fmt::format("ODOM {} 0 0 0 0 0 {} host {:.2f}\n", i, odometry_stamp(i), 0.1 * i + 0.05);
  }
  return text;
}
std::string good(int i) { return fmt::format("{:.2f}", 1e9 + 0.1 * i); }
std::string good_odometry(int i) { return fmt::format("{:.2f}", 1e9 + 0.1 * i + 0.05); }

Log load_of(const std::function<std::string(int)>& scan_stamp,
            const std::function<std::string(int)>& odometry_stamp = good_odometry) {
  auto log = load_text({log_of(scan_stamp, odometry_stamp), false}, "f", std::nullopt, {});
  EXPECT_TRUE(log) << log.error().text();
  return log.value_or(Log{});
}

bool noted(const Log& log, const std::string& text) {
  for (const std::string& note : notes(log, "f", log.scan_report)) {
    if (note == text) return true;
  }
  return false;
}

/// The log with the stamp of scan `at` set to that text.
Log with_stamp(int at, const std::string& stamp) {
  return load_of([&](int i) { return i == at ? stamp : good(i); });
}

TEST(Stamps, ARowOfAnotherClockIsDroppedWhereverItIs) {
  for (const int at : {0, 1, 50, 98, 99}) {
    for (const char* stamp : {"0", "12.5", "1700000000", "1000007200", "999990000"}) {
      const Log log = with_stamp(at, stamp);
      EXPECT_EQ(log.scans.size(), 99U) << at << " at " << stamp;
      EXPECT_EQ(log.scan_report.repaired(RepairKind::kOtherClock), 1) << at << " at " << stamp;
      EXPECT_EQ(log.scan_report.dropped(), 1);
      EXPECT_LT(log.end_ns, 10'000'000'000) << at << " at " << stamp;
      EXPECT_TRUE(noted(log, "log `f`: dropped 1 rows with stamps of another clock"));
    }
  }
}

TEST(Stamps, ARowThatStepsBackALittleIsSorted) {
  const Log log = with_stamp(50, "1000000004.55");
  ASSERT_EQ(log.scans.size(), 100U);
  EXPECT_EQ(log.scan_report.repaired(RepairKind::kStepBack), 1);
  EXPECT_EQ(log.scans[46].t_ns, 4'550'000'000);
  EXPECT_TRUE(noted(log, "log `f`: sorted 1 rows with stamps out of order"));
}

TEST(Stamps, ARowWithoutATimeIsDropped) {
  for (const char* stamp : {"nan", "-1", "when", "1e300"}) {
    const Log log = with_stamp(50, stamp);
    EXPECT_EQ(log.scans.size(), 99U) << stamp;
    EXPECT_EQ(log.scan_report.repaired(RepairKind::kJunkStamp), 1);
  }
}

TEST(Stamps, APauseIsNoOtherClock) {
  const auto paused = [](int i) {
    return fmt::format("{:.2f}", 1e9 + 0.1 * i + (i < 40 ? 0 : 7200));
  };
  const Log log = load_of(paused, paused);
  EXPECT_EQ(log.scans.size(), 100U);
  EXPECT_EQ(log.odometry.size(), 100U);
}

TEST(Stamps, OdometryOfAnotherClockIsDroppedAndTheScansStay) {
  const Log log = load_of(good, [](int i) { return i == 3 ? "1700000000" : good_odometry(i); });
  EXPECT_EQ(log.scans.size(), 100U);
  EXPECT_EQ(log.odometry.size(), 99U);
  EXPECT_EQ(log.odometry_report.repaired(RepairKind::kOtherClock), 1);
}

TEST(Stamps, IfMostRowsAreOfDifferentClocksThatOfTheLoggerCounts) {
  const Log half = load_of([](int i) { return i % 2 == 0 ? "5" : good(i); });
  EXPECT_EQ(half.stamped_by, StampedBy::kLogger);
  EXPECT_EQ(half.scans.size(), 100U);
  EXPECT_TRUE(
      noted(half,
            "log `f`: the stamps are those of the logger, because those of the messages are "
            "of several clocks"));
  const Log apart = load_of(good, [](int i) { return fmt::format("{:.2f}", 17e8 + 0.1 * i); });
  EXPECT_EQ(apart.stamped_by, StampedBy::kLogger);
  EXPECT_EQ(apart.odometry.size(), 100U);
}

}  // namespace
}  // namespace rave::carmen
