// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_parameters.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace rave::scip {
namespace {

using Lines = std::vector<std::string_view>;

const Lines kUrg = {"MODL:URG-04LX(Hokuyo Automatic Co.,Ltd.)",
                    "DMIN:20",
                    "DMAX:5600",
                    "ARES:1024",
                    "AMIN:44",
                    "AMAX:725",
                    "AFRT:384",
                    "SCAN:600"};

std::string error_with(std::size_t line, std::string_view text) {
  Lines lines = kUrg;
  lines[line] = text;
  const auto parsed = parse_parameters(lines);
  return parsed ? "none" : parsed.error().text();
}

TEST(Parameters, OfTheUrg04lx) {
  const auto urg = parse_parameters(kUrg);
  ASSERT_TRUE(urg) << urg.error().text();
  EXPECT_EQ(*urg,
            (Parameters{"URG-04LX(Hokuyo Automatic Co.,Ltd.)", 20, 5600, 1024, 44, 725, 384, 600}));
  EXPECT_DOUBLE_EQ(urg->scan_period_s(), 0.1);
  EXPECT_DOUBLE_EQ(urg->bearing_rad(384), 0);
  EXPECT_DOUBLE_EQ(urg->bearing_rad(384 + 256), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(urg->bearing_rad(384 - 256), -std::numbers::pi / 2);
}

TEST(Parameters, SayWhatIsWrong) {
  EXPECT_EQ(error_with(1, "XMIN:20"), "the reply to PP has no `DMIN`");
  EXPECT_EQ(error_with(3, "ARES:0"), "the reply to PP has `ARES:0`; expected 1 to 9999");
  EXPECT_EQ(error_with(3, "ARES:1e3"), "the reply to PP has `ARES:1e3`; expected 1 to 9999");
  EXPECT_EQ(error_with(5, "AMAX:43"), "the reply to PP has `AMAX:43`; expected 44 to 1024");
  EXPECT_EQ(error_with(7, "SCAN:-1"), "the reply to PP has `SCAN:-1`; expected 1 to 60000");
  EXPECT_EQ(error_with(7, "AMIN:44"), "the reply to PP has `AMIN` twice");
}

}  // namespace
}  // namespace rave::scip
