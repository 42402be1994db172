// SPDX-License-Identifier: Apache-2.0
#include "utias/text_log.hpp"

#include <gtest/gtest.h>

#include "utias/streams.hpp"

namespace rave::utias {
namespace {

Result<ParsedLog> odometry(const std::string& text, bool accept_cut = false) {
  return parse_log({text, false}, "o.dat", odometry_columns(), accept_cut);
}

std::string odometry_error(const std::string& text) {
  const auto log = odometry(text);
  return log ? "no error" : log.error().text();
}

TEST(TextLog, ReadsRowsCommentsBlankLinesAndBothLineEnds) {
  const auto log = odometry("# head\n1.5 \t 0.25 \t -0.5\r\n\n2.0 1 2\n");
  ASSERT_TRUE(log) << log.error().text();
  ASSERT_EQ(log->rows.size(), 2U);
  EXPECT_EQ(log->rows[0].stamp_ns, 1500000000);
  EXPECT_EQ(log->rows[0].reals[0], 0.25);
  EXPECT_EQ(log->rows[0].reals[1], -0.5);
  EXPECT_EQ(log->rows[1].line, 4);
  EXPECT_TRUE(log->repairs.empty());
}

TEST(TextLog, NamesThePlaceOfAWrongRow) {
  EXPECT_EQ(odometry_error("1.0 2\n2.0 1 2\n"),
            "o.dat:1:6: expected 3 columns (time [s], forward velocity [m/s], angular velocity "
            "[rad/s]), found 2");
  EXPECT_EQ(odometry_error("# a\n1.0 2 3  4\n"),
            "o.dat:2:10: expected 3 columns (time [s], forward velocity [m/s], angular velocity "
            "[rad/s]), found 4");
  EXPECT_EQ(odometry_error("1.0 0.1x 0\n"),
            "o.dat:1:5: forward velocity [m/s] is `0.1x`: expected a finite number within +-1e6");
  EXPECT_EQ(odometry_error("-1.0 0 0\n"),
            "o.dat:1:1: time [s] is `-1.0`: expected seconds with at most nine decimals");
}

TEST(TextLog, RefusesNanAndInfinity) {
  EXPECT_EQ(odometry_error("1.0 0.1 0\n1.1 0.1 nan\n"),
            "o.dat:2:9: angular velocity [rad/s] is `nan`: expected a finite number within +-1e6");
  EXPECT_EQ(odometry_error("1.0 -inf 0\n"),
            "o.dat:1:5: forward velocity [m/s] is `-inf`: expected a finite number within +-1e6");
  EXPECT_EQ(odometry_error("nan 0 0\n"),
            "o.dat:1:1: time [s] is `nan`: expected seconds with at most nine decimals");
  // Not taken for a cut line either.
  EXPECT_EQ(odometry_error("1.0 0.1 0\n1.1 0.1 nan"),
            "o.dat:2:9: angular velocity [rad/s] is `nan`: expected a finite number within +-1e6");
}

TEST(TextLog, RefusesImpossibleSightings) {
  const auto error = [](const std::string& text) {
    return parse_log({text, false}, "m.dat", sighting_columns(), {}).error().text();
  };
  EXPECT_EQ(error("1.0 5 -0.1 0\n"),
            "m.dat:1:7: range [m] is `-0.1`: expected a finite number from 0 to 1e6");
  EXPECT_EQ(error("1.0 5.5 1 0\n"),
            "m.dat:1:5: barcode is `5.5`: expected a whole number from 0 to 1000000");
}

TEST(TextLog, RefusesALogCutInTheMiddleOfALine) {
  const std::string advice = "; fetch the whole file, or set accept_cut to use the 1 whole rows";
  const std::string middle = "the log ends in the middle of this line" + advice;
  EXPECT_EQ(odometry_error("1.0 0.10 0.10\n1.1 0.1"), "o.dat:2:8: " + middle);
  EXPECT_EQ(odometry_error("1.0 0.10 0.10\n1.1 0.10 -"), "o.dat:2:11: " + middle);
  // All columns are there, yet the last number has lost a digit.
  EXPECT_EQ(odometry_error("1.0 0.10 0.10\n1.1 0.10 0.1"), "o.dat:2:13: " + middle);
  EXPECT_EQ(odometry_error("1.0 0.10 0.10\n1.1 0.10 0.11"), "no error");
}

TEST(TextLog, KeepsWhatIsWholeOfACutLogIfAsked) {
  const auto log = odometry("1.0 0.10 0.10\n1.1 0.1", true);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->rows.size(), 1U);
  ASSERT_EQ(log->repairs.size(), 1U);
  EXPECT_EQ(log->repairs[0].kind, RepairKind::kCutLine);
  EXPECT_EQ(log->repairs[0].first_line, 2);
}

TEST(TextLog, AGzipStreamThatBreaksOffIsACutLogEvenAtALineEnd) {
  const auto cut = [](const std::string& text, bool accept) {
    return parse_log({text, true}, "o.gz", odometry_columns(), accept);
  };
  EXPECT_EQ(cut("1.0 0.1 0.1\n", false).error().text(),
            "o.gz:2:1: the gzip stream is truncated after the previous line; fetch the "
            "whole file, or set accept_cut to use the 1 whole rows");
  EXPECT_EQ(cut("1.0 0.1 0.1\n2.0 0.1 0.1", false).error().text(),
            "o.gz:2:12: the gzip stream ends in the middle of this line; fetch the whole file, or "
            "set accept_cut to use the 1 whole rows");
  EXPECT_EQ(cut("1.0 0.1 0.1\n2.0 0.1 0.1", true)->rows.size(), 1U);
  EXPECT_EQ(cut("1.0 0.1 0.1\n", true)->repairs.size(), 1U);
}

}  // namespace
}  // namespace rave::utias
