// SPDX-License-Identifier: Apache-2.0
#include "carmen/log_text.hpp"

#include <gtest/gtest.h>

#include "small_log.hpp"

namespace rave::carmen {
namespace {

using recording::RepairKind;

std::string error_of(const std::string& text, bool accept_cut = false) {
  const auto log = parse_log({text, false}, "f", accept_cut);
  return log ? "no error" : log.error().text();
}

TEST(LogText, ReadsScansAndOdometry) {
  const auto log = parse_log({small_log(), false}, "f", false);
  ASSERT_TRUE(log) << log.error().text();
  EXPECT_EQ(log->beams, 4U);
  ASSERT_EQ(log->scans.size(), 3U);
  EXPECT_EQ(log->scans[1].line, 6);
  EXPECT_EQ(log->scans[1].stamp_ns, 10'750'000'000);
  EXPECT_EQ(log->scans[0].X_WL, (Pose2{0.1, 0.2, 3.3}));
  EXPECT_EQ(log->ranges(log->scans[0])[2], 81.91F);
  EXPECT_EQ(log->ranges(log->scans[2])[0], 1.3F);
  ASSERT_EQ(log->odometry.size(), 2U);
  EXPECT_EQ(log->odometry[1].v_mps, 0.4);
  EXPECT_EQ(log->odometry[1].w_radps, 0.1);
  EXPECT_EQ(log->passed_over, 2) << "PARAM and NEFF";
  EXPECT_TRUE(log->scan_repairs.empty());
  ASSERT_EQ(log->odometry_repairs.size(), 1U);
  EXPECT_EQ(log->odometry_repairs[0].kind, RepairKind::kJunkStamp);
  EXPECT_EQ(log->odometry_repairs[0].first_line, 4);
}

TEST(LogText, JunkStandsOnlyRightBehindAScan) {
  EXPECT_EQ(error_of(altered("0 0 0 0 host 0\n", "0 0 0 8.5e-67 host 0\n")), "no error");
  EXPECT_EQ(error_of(altered("0 0 0 0 host 0\n", "0 0 0 zero host 0\n")),
            "f:4:24: ipc_timestamp is `zero`: expected seconds with at most nine decimals");
  EXPECT_EQ(error_of(altered("0.1 0 10.8 host", "0.1 0 8.5e-67 host")),
            "f:8:29: ipc_timestamp is `8.5e-67`: expected seconds with at most nine decimals");
  const auto log = parse_log({altered("0.1 0 10.8 host", "0.1 0 0 host"), false}, "f", false);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->odometry.size(), 2U) << "0 is a time like any other where it can be one";
}

TEST(LogText, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(error_of(altered("NEFF", "NEF")),
            "f:5:1: `NEF` is not a message of a CARMEN log; did you mean `NEFF`?");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 4 x")),
            "f:3:10: range [m] is `x`: expected a number from 0 to 1000");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 4 -1")),
            "f:3:10: range [m] is `-1`: expected a number from 0 to 1000");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 4 nan")),
            "f:3:10: range [m] is `nan`: expected a number from 0 to 1000");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 0 1.5")),
            "f:3:8: the number of ranges is `0`: expected 1 to 100000");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 4000000000 1.5")),
            "f:3:8: the number of ranges is `4000000000`: expected 1 to 100000");
  EXPECT_EQ(error_of(altered("FLASER 4 1.5", "FLASER 5 1.5")),
            "f:3:65: FLASER: expected 16 words, found 15 words");
  EXPECT_EQ(error_of(altered("FLASER 4 1.4 2", "FLASER 3 2")),
            "f:6:8: this scan has 3 ranges, the scans before it 4");
  EXPECT_EQ(error_of(altered("0.1 0.2 3.3 0.1 0.2 3.3 10.5", "0.1 1e7 3.3 0.1 0.2 3.3 10.5")),
            "f:3:31: y [m] is `1e7`: expected a number from -1e+06 to 1e+06");
  EXPECT_EQ(error_of(altered("10.5 host 10.5", "-1 host 10.5")),
            "f:3:51: ipc_timestamp is `-1`: expected seconds with at most nine decimals");
  EXPECT_EQ(error_of("FLASER\n"), "f:1:7: FLASER: expected the number of ranges, found 1 words");
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
