// SPDX-License-Identifier: Apache-2.0
#include "recording/stream_report.hpp"

#include <gtest/gtest.h>

namespace rave::recording {
namespace {

StreamReport described(std::vector<std::int64_t> stamps, std::int64_t start, std::int64_t end) {
  StreamReport report;
  report.gap_limit_ns = 10;
  describe_timing(report, stamps, start, end);
  return report;
}

TEST(StreamReport, CountsOnlyTheWindow) {
  const StreamReport report = described({95, 100, 105, 105, 110, 120, 130}, 100, 120);
  EXPECT_EQ(report.rows, 5);
  EXPECT_EQ(report.stamps, 4);
  EXPECT_EQ(report.first_ns, 100);
  EXPECT_EQ(report.last_ns, 120);
  EXPECT_DOUBLE_EQ(report.mean_rate_hz, 4 / 20e-9);
  EXPECT_TRUE(report.gaps.empty());
  EXPECT_EQ(report.largest_gap_ns, 10);
  EXPECT_EQ(report.largest_age_ns, 10);
}

TEST(StreamReport, SeesGapsThatReachAcrossTheEdges) {
  const StreamReport report = described({80, 105, 110, 150}, 100, 120);
  ASSERT_EQ(report.gaps.size(), 2U);
  EXPECT_EQ(report.gaps[0].start_ns, 80);
  EXPECT_EQ(report.gaps[0].length_ns, 25);
  EXPECT_EQ(report.gaps[1].length_ns, 40);
  EXPECT_EQ(report.largest_age_ns, 25) << "the later gap is only 10 old when the window ends";
}

TEST(StreamReport, SeesALateStartAndAnEarlyEnd) {
  const StreamReport report = described({120, 125}, 100, 160);
  ASSERT_EQ(report.gaps.size(), 2U);
  EXPECT_EQ(report.gaps[0].kind, GapKind::kLateStart);
  EXPECT_EQ(report.gaps[0].length_ns, 20);
  EXPECT_EQ(report.gaps[1].kind, GapKind::kEarlyEnd);
  EXPECT_EQ(report.gaps[1].start_ns, 125);
  EXPECT_EQ(report.gaps[1].length_ns, 35);
  EXPECT_EQ(report.largest_age_ns, 35);
}

TEST(StreamReport, AnEmptyStreamIsOneGap) {
  const StreamReport report = described({}, 100, 160);
  ASSERT_EQ(report.gaps.size(), 1U);
  EXPECT_EQ(report.gaps[0].length_ns, 60);
  EXPECT_EQ(report.rows, 0);
  EXPECT_FALSE(report.first_ns);
}

}  // namespace
}  // namespace rave::recording
