// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/error_codes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rave::scip {
namespace {

TEST(ErrorCodes, AreThoseOfTheModel) {
  for (const char* const older :
       {"URG-04LX(Hokuyo Automatic Co.,Ltd.)", "URG-04LX-UG01", "UBG-04LX-F01", "UHG-08LX"}) {
    EXPECT_EQ(error_codes_of(older), ErrorCodes::kReasons) << older;
  }
  for (const char* const later : {"UTM-30LX(Hokuyo Automatic Co.,Ltd.)", "UST-10LX", ""}) {
    EXPECT_EQ(error_codes_of(later), ErrorCodes::kDistances) << later;
  }
}

TEST(ErrorCodes, OnlyOneOfThemIsFreeSpace) {
  for (int code = 0; code < kLeastRange_mm; ++code) {
    EXPECT_TRUE(std::isnan(range_of_code(code, ErrorCodes::kReasons, 0.02F))) << code;
    const float later_m = range_of_code(code, ErrorCodes::kDistances, 0.02F);
    EXPECT_EQ(std::isinf(later_m), code == 1) << code;
    EXPECT_EQ(later_m == 0.02F, code == 2) << code;
    EXPECT_EQ(std::isnan(later_m), code != 1 && code != 2) << code;
  }
}

}  // namespace
}  // namespace rave::scip
