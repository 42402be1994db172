// SPDX-License-Identifier: Apache-2.0
#include "rave/report/progress.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "rave/base/text_width.hpp"

namespace rave::report {
namespace {

Progress half_way() { return {0.5, 160, 220.0, 10.04, 16, "closest 0.43 m (4, 5)"}; }

TEST(Progress, SaysEverythingWhereThereIsRoom) {
  const std::string line = format_progress(half_way(), 100);
  EXPECT_EQ(line,
            "│████████        │   50 %  160.0 of 220.0 s  10x  16 robots  closest 0.43 m (4, 5)" +
                std::string(18, ' '));
}

TEST(Progress, IsExactlyAsWideAsTheTerminal) {
  for (std::size_t width = 0; width < 140; ++width) {
    EXPECT_EQ(columns_of(format_progress(half_way(), width)), width);
  }
}

TEST(Progress, LeavesOutTheLeastImportantFirst) {
  EXPECT_NE(format_progress(half_way(), 70).find("closest"), std::string::npos);
  EXPECT_NE(format_progress(half_way(), 70).find("…"), std::string::npos);
  EXPECT_EQ(format_progress(half_way(), 52).find("robots"), std::string::npos);
  const std::string narrow = format_progress(half_way(), 25);
  EXPECT_EQ(narrow, " 50 %  160.0 of 220.0 s  ");
}

TEST(Progress, OpenEndAndStrangeNumbers) {
  Progress progress = half_way();
  progress.end_s.reset();
  progress.robots = 1;
  progress.pace = 0.25;
  progress.text = "a\r\nb";
  EXPECT_EQ(format_progress(progress, 28), "160.0 s  0.2x  1 robot      ");
  EXPECT_NE(format_progress(progress, 60).find("1 robot  ab"), std::string::npos);
  progress = half_way();
  progress.fraction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(format_progress(progress, 100).find("  0 %"), std::string::npos);
  progress.fraction = 7;
  EXPECT_NE(format_progress(progress, 100).find("100 %"), std::string::npos);
  EXPECT_NE(format_progress(progress, 100).find("│████████████████│"), std::string::npos);
}

}  // namespace
}  // namespace rave::report
