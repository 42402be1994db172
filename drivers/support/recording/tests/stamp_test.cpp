// SPDX-License-Identifier: Apache-2.0
#include "recording/stamp.hpp"

#include <gtest/gtest.h>

namespace rave::recording {
namespace {

TEST(Stamp, IsExactToTheNanosecond) {
  EXPECT_EQ(parse_stamp_ns("1248444175.103"), 1248444175103000000);
  EXPECT_EQ(parse_stamp_ns("1248444175.123456789"), 1248444175123456789);
  EXPECT_EQ(parse_stamp_ns("100"), 100000000000);
  EXPECT_EQ(parse_stamp_ns("0.5"), 500000000);
  EXPECT_EQ(parse_stamp_ns("4000000000"), kLatestStamp_ns);
}

TEST(Stamp, RefusesAllElse) {
  for (const char* text : {"", ".", "1.", "-1.0", "+1", "1e9", "1.0 ", "nan", "1.1.1",
                           "0.1234567891", "4000000000.1", "99999999999999999999", "0x10"}) {
    EXPECT_FALSE(parse_stamp_ns(text)) << text;
  }
}

}  // namespace
}  // namespace rave::recording
