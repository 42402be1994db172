// SPDX-License-Identifier: Apache-2.0
#include "hybrid_ranges.hpp"

#include <cmath>
#include <limits>

#include "fusing.hpp"

namespace rave {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Ranges = testing::Fusing<HybridRanges>;

float one(Ranges& fusing, float real, float imagined) {
  const auto result = fusing.fuse<float>({real}, {imagined});
  return result.size() == 1 ? result[0] : -1;
}

TEST(HybridRanges, NearestIsTheMinimumWithNoReturnAsInfinity) {
  Ranges fusing;
  ASSERT_TRUE(fusing.start());
  EXPECT_EQ(one(fusing, 2, 1.2F), 1.2F);
  EXPECT_EQ(one(fusing, 1, 1.2F), 1);
  EXPECT_EQ(one(fusing, kNone, 1.2F), 1.2F);
  EXPECT_EQ(one(fusing, 2, kNone), 2);
  EXPECT_EQ(one(fusing, kNone, kNone), kNone);
}

TEST(HybridRanges, AnInvalidRayIsNeverMadeFree) {
  for (const char* rule : {"nearest", "occlusion"}) {
    Ranges fusing;
    fusing.real().range_min_m = 0.5;
    fusing.real().range_max_m = 4;
    fusing.set("rule", rule);
    ASSERT_TRUE(fusing.start());
    EXPECT_TRUE(std::isnan(one(fusing, kNan, kNone))) << rule;
    EXPECT_TRUE(std::isnan(one(fusing, kNan, kNan))) << rule;
    EXPECT_EQ(one(fusing, kNan, 1.2F), 1.2F) << rule;
    EXPECT_EQ(one(fusing, 0, 1.2F), 0) << rule;  // an error code below the least range stays
    EXPECT_EQ(one(fusing, 0.3F, kNone), 0.3F) << rule;
    EXPECT_EQ(one(fusing, 2, kNan), 2) << rule;
    EXPECT_EQ(one(fusing, kNone, kNan), kNone) << rule;
  }
}

TEST(HybridRanges, OcclusionAsksWhatTheRealSensorWouldHaveSeen) {
  Ranges fusing;
  fusing.real().range_min_m = 0.5;
  fusing.real().range_max_m = 4;
  fusing.set("rule", "occlusion");
  ASSERT_TRUE(fusing.start());
  EXPECT_EQ(one(fusing, 3, 1.2F), 1.2F);
  EXPECT_EQ(one(fusing, 1, 1.2F), 1);
  EXPECT_EQ(one(fusing, kNone, 3.9F), 3.9F);
  EXPECT_EQ(one(fusing, kNone, 4), 4);
  EXPECT_EQ(one(fusing, kNone, 4.1F), kNone);
  EXPECT_TRUE(std::isnan(one(fusing, kNan, 4.1F)));
}

TEST(HybridRanges, ABodyTooNearReadsAsTheRealSensorReadsIt) {
  const auto read = [](const char* too_near) {
    Ranges fusing;
    fusing.real().range_min_m = 0.5;
    fusing.real().range_max_m = 4;
    fusing.set("rule", "occlusion");
    fusing.set("too_near", too_near);
    EXPECT_TRUE(fusing.start());
    return one(fusing, 3, 0.2F);
  };
  EXPECT_EQ(read("range_min"), 0.5F);
  EXPECT_EQ(read("no_return"), kNone);
  EXPECT_TRUE(std::isnan(read("invalid")));
}

TEST(HybridRanges, EachRayIsForItself) {
  Ranges fusing(4);
  ASSERT_TRUE(fusing.start());
  EXPECT_EQ(fusing.fuse<float>({1, 2, 3, 4}, {4, 3, 2, 1}), (std::vector<float>{1, 2, 2, 1}));
  EXPECT_EQ(fusing.fuse<float>({1, 2, 3, 4}, {0.5F}), (std::vector<float>{0.5F, 2, 3, 4}));
  EXPECT_TRUE(fusing.fuse<float>({}, {4, 3, 2, 1}).empty());
}

TEST(HybridRanges, SaysWhatDoesNotFit) {
  Ranges counts(4);
  counts.imagined().capacity = 3;
  const Status other = counts.start();
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().text(), "the real half has 4 rays, the virtual one 3");
  Ranges limits;
  limits.set("rule", "occlusion");
  const Status none = limits.start();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().text(),
            "the rule `occlusion` needs the range limits of the real half, which says 0 to 0 m; "
            "expected the rule `nearest`");
}

}  // namespace
}  // namespace rave
