// SPDX-License-Identifier: Apache-2.0
#include "carmen/log_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "small_log.hpp"

namespace rave::carmen {
namespace {

using recording::RepairKind;

/// The error of the only row that is refused.
std::string refusal_of(const std::string& text) {
  const auto log = parse_log({text, false}, "f", false);
  if (!log) return log.error().text();
  return log->refusals.size() == 1 ? log->refusals.front()
                                   : std::to_string(log->refusals.size()) + " rows are refused";
}

std::int64_t passed_over(const ParsedLog& log, const std::string& name) {
  for (const PassedOver& other : log.passed_over) {
    if (other.name == name) return other.count;
  }
  return 0;
}

std::string error_of(const std::string& text, bool accept_cut = false) {
  const auto log = parse_log({text, false}, "f", accept_cut);
  return log ? "no error" : log.error().text();
}

TEST(LogText, ReadsScansAndOdometry) {
  const auto log = parse_log({small_log(), false}, "f", false);
  ASSERT_TRUE(log) << log.error().text();
  ASSERT_EQ(log->scans.size(), 3U);
  EXPECT_EQ(log->scans[1].line, 6);
  EXPECT_EQ(log->scans[1].beams, 4U);
  EXPECT_EQ(log->scans[1].stamps.message_ns, 10'750'000'000);
  EXPECT_EQ(log->scans[0].X_WL, (Pose2{0.1, 0.2, 3.3}));
  EXPECT_EQ(log->ranges(log->scans[0])[2], 81.91F);
  EXPECT_EQ(log->ranges(log->scans[2])[0], 1.3F);
  ASSERT_EQ(log->odometry.size(), 2U);
  EXPECT_EQ(log->odometry[1].v_mps, 0.4);
  EXPECT_EQ(log->odometry[1].w_radps, 0.1);
  EXPECT_EQ(passed_over(*log, "PARAM"), 1);
  EXPECT_EQ(passed_over(*log, "NEFF"), 1);
  EXPECT_EQ(log->laser_offset_m, 0.1);
  EXPECT_TRUE(log->scan_repairs.empty());
  ASSERT_EQ(log->odometry_repairs.size(), 1U);
  EXPECT_EQ(log->odometry_repairs[0].kind, RepairKind::kJunkStamp);
  EXPECT_EQ(log->odometry_repairs[0].first_line, 4);
}

TEST(LogText, JunkStandsOnlyRightBehindAScan) {
  const auto rows = [](const std::string& from, const std::string& to) {
    const auto log = parse_log({altered(from, to), false}, "f", false);
    return log ? log->odometry.size() : 0;
  };
  EXPECT_EQ(rows("0 0 0 0 host 0\n", "0 0 0 8.5e-67 host 0\n"), 2U);
  EXPECT_EQ(rows("0 0 0 0 host 0\n", "0 0 0 zero host 0\n"), 2U);
  EXPECT_EQ(rows("0.1 0 10.8 host", "0.1 0 0 host"), 2U)
      << "0 is a time like any other where it can be one";
}

TEST(LogText, ARowThatCannotBeReadIsRefusedByItself) {
  EXPECT_EQ(refusal_of(altered("FLASER 4 1.5", "FLASER 4 x")),
            "f:3:10: range [m] is `x`: expected a number");
  EXPECT_EQ(refusal_of(altered("FLASER 4 1.5", "FLASER 0 1.5")),
            "f:3:8: the number of ranges is `0`: expected 1 to 100000");
  EXPECT_EQ(refusal_of(altered("FLASER 4 1.5", "FLASER 4000000000 1.5")),
            "f:3:8: the number of ranges is `4000000000`: expected 1 to 100000");
  EXPECT_EQ(refusal_of(altered("FLASER 4 1.5", "FLASER 5 1.5")),
            "f:3:65: FLASER: expected 16 words, found 15 words");
  EXPECT_EQ(refusal_of(altered("0.1 0.2 3.3 0.1 0.2 3.3 10.5", "0.1 1e7 3.3 0.1 0.2 3.3 10.5")),
            "f:3:31: y [m] is `1e7`: expected a number from -1e+06 to 1e+06");
  EXPECT_EQ(refusal_of(altered("0.25 0.2 3.0", "0.25 nan 3.0")),
            "f:8:11: y [m] is `nan`: expected a number from -1e+06 to 1e+06");
  EXPECT_EQ(refusal_of("FLASER\n"), "f:1:7: FLASER: expected the number of ranges, found 1 words");
  const auto log = parse_log({altered("FLASER 4 1.4 2", "FLASER 4 1.4 x"), false}, "f", false);
  ASSERT_TRUE(log);
  ASSERT_EQ(log->scans.size(), 2U);
  EXPECT_EQ(log->ranges(log->scans[1])[0], 1.3F) << "no range of the refused row is left";
  ASSERT_EQ(log->scan_repairs.size(), 1U);
  EXPECT_EQ(log->scan_repairs[0].kind, RepairKind::kRefusedRow);
  EXPECT_EQ(log->scan_repairs[0].first_line, 6);
}

TEST(LogText, ARangeThatIsNoNumberIsNotKnown) {
  for (const char* text : {"nan", "-nan", "-1"}) {
    const auto log =
        parse_log({altered("FLASER 4 1.5", std::string("FLASER 4 ") + text), false}, "f", false);
    ASSERT_TRUE(log);
    ASSERT_EQ(log->scans.size(), 3U) << text;
    EXPECT_TRUE(std::isnan(log->ranges(log->scans[0])[0])) << text;
    EXPECT_EQ(log->ranges(log->scans[0])[1], 2);
  }
  const auto log = parse_log({altered("FLASER 4 1.5", "FLASER 4 1e300"), false}, "f", false);
  ASSERT_TRUE(log);
  EXPECT_GT(log->ranges(log->scans[0])[0], 1e30F);
}

TEST(LogText, PassesOverUnknownMessagesAndCountsThemByName) {
  const auto log = parse_log({"COMMENT made by hand\nREMISSIONFLASER 2 1 0.5 2 0.5 1 h 1\n"
                              "NMEA $GPGGA,1\nREMISSIONFLASER\nRLASER 1 1 0 0 0 0 0 0 1 h 1\n" +
                                  small_log(),
                              false},
                             "f", false);
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->scans.size(), 3U);
  EXPECT_EQ(passed_over(*log, "COMMENT"), 1);
  EXPECT_EQ(passed_over(*log, "REMISSIONFLASER"), 2);
  EXPECT_EQ(passed_over(*log, "NMEA"), 1);
  EXPECT_EQ(passed_over(*log, "RLASER"), 1);
  for (const PassedOver& other : log->passed_over) {
    EXPECT_EQ(other.known, other.name == "RLASER" || other.name == "PARAM" || other.name == "NEFF");
  }
}

TEST(LogText, AFileThatIsNoLogHasFewKinds) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "word" + std::to_string(i) + "\n";
  const auto log = parse_log({text, false}, "f", false);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->passed_over.size(), 25U);
  EXPECT_EQ(passed_over(*log, "others"), 976);
}

/// The layout that the readers of CARMEN expect: with remissions, and five numbers behind the
/// poses.
TEST(LogText, ReadsTheNewerScansAsCarmenDoes) {
  const std::string row =
      " 0 -1.5 3 0.75 30 0.01 0 5 1 2 3 4 nan 3 77 78 79 0.1 0.2 0.3 8 9 1 0.5 0.2 0 0 0 12.5 "
      "host 3.25\n";
  const auto log = parse_log({"ROBOTLASER1" + row, false}, "f", false);
  ASSERT_TRUE(log);
  ASSERT_EQ(log->scans.size(), 1U) << log->refusals.at(0);
  const ScanRow& scan = log->scans[0];
  EXPECT_EQ(scan.X_WL, (Pose2{0.1, 0.2, 0.3}));
  EXPECT_EQ(scan.start_rad, -1.5);
  EXPECT_EQ(scan.step_rad, 0.75);
  EXPECT_EQ(scan.maximum_m, 30);
  EXPECT_EQ(scan.stamps.message_ns, 12'500'000'000);
  EXPECT_EQ(scan.stamps.logger_ns, 3'250'000'000);
  ASSERT_EQ(scan.beams, 5U);
  EXPECT_EQ(log->ranges(scan)[3], 4);
  const auto rear = parse_log({"ROBOTLASER2" + row, false}, "f", false, LaserSide::kRear);
  ASSERT_TRUE(rear);
  EXPECT_EQ(rear->scans.size(), 1U);
  const auto raw =
      parse_log({"RAWLASER1 0 -1.5 3 0.75 30 0.01 0 2 1 2 0 12.5 host 3.25\n", false}, "f", false);
  ASSERT_TRUE(raw);
  ASSERT_EQ(raw->scans.size(), 1U) << raw->refusals.at(0);
  EXPECT_FALSE(raw->scans[0].X_WL);
}

TEST(LogText, ANewerScanThatLostAWordIsRefused) {
  const std::string row =
      "ROBOTLASER1 0 -1.5 3 0.75 30 0.01 0 2 1.5 2.5 1 77.5 0 0 0 0 0 0 0 0 0 0 0 1 h 1";
  ASSERT_EQ(refusal_of(row + "\n"), "0 rows are refused");
  for (std::size_t space = row.find(' '); space != std::string::npos;
       space = row.find(' ', space + 1)) {
    std::string cut = row;
    cut.erase(space, row.find(' ', space + 1) == std::string::npos
                         ? std::string::npos
                         : row.find(' ', space + 1) - space);
    EXPECT_EQ(refusal_of(cut + "\n").find("f:1:"), 0U) << cut;
  }
}

TEST(LogText, ACutLineIsSeenWhereverItWasCut) {
  const std::string whole = small_log();
  const std::size_t last = whole.rfind("FLASER");
  for (std::size_t size = last + 1; size < whole.size(); ++size) {
    const std::string cut = whole.substr(0, size);
    EXPECT_TRUE(error_of(cut).starts_with("f:9:")) << error_of(cut);
    const auto log = parse_log({cut, false}, "f", true);
    ASSERT_TRUE(log) << log.error().text();
    EXPECT_EQ(log->scans.size(), 2U);
    ASSERT_EQ(log->scan_repairs.size(), 1U);
    EXPECT_EQ(log->scan_repairs[0].kind, RepairKind::kCutLine);
  }
  EXPECT_EQ(error_of(whole.substr(0, last)), "no error");
  const auto gzip = parse_log({whole.substr(0, last), true}, "f", false);
  ASSERT_FALSE(gzip);
  EXPECT_EQ(gzip.error().text(),
            "f:9:1: the gzip stream is truncated after the previous line; fetch the whole "
            "file, or set accept_cut to use the 2 whole scans");
}

}  // namespace
}  // namespace rave::carmen
