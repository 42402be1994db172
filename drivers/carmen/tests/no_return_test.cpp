// SPDX-License-Identifier: Apache-2.0
#include "carmen/no_return.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <vector>

#include "carmen/log.hpp"

namespace rave::carmen {
namespace {

std::filesystem::path shipped_log() {
  return std::filesystem::path(RAVE_SOURCE_DIR) / "data/freiburg-079/104-224/freiburg-079.log.gz";
}

/// The ranges of a log as they are written.
std::vector<float> written(const std::filesystem::path& path) {
  LoadOptions options;
  options.range_max_m = 1000;
  options.no_return_m = 0;
  const auto log = load(path, options);
  EXPECT_TRUE(log) << log.error().text();
  return log ? log->ranges_m : std::vector<float>{};
}

void expect_found_at_any_limit(const std::vector<float>& ranges_m, float no_return_m) {
  const auto found = find_no_return(ranges_m, 1000);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->range_m, no_return_m);
  EXPECT_GT(found->rays, ranges_m.size() / 100);
  EXPECT_FALSE(find_no_return(ranges_m, 80)) << "what is left are walls";
  // The same robot with a laser of a shorter reach.
  for (const float limit_m : {2.0F, 4.095F, 8.0F, 15.0F, 30.0F, 51.15F}) {
    std::vector<float> limited(ranges_m);
    for (float& range_m : limited) range_m = std::min(range_m, limit_m);
    const auto limit = find_no_return(limited, 80);
    ASSERT_TRUE(limit) << limit_m;
    EXPECT_EQ(limit->range_m, limit_m);
  }
}

TEST(NoReturn, IsFoundInTheShippedLogAtAnyLimit) {
  expect_found_at_any_limit(written(shipped_log()), 81.91F);
}

TEST(NoReturn, IsFoundInTheWholeLogsAtAnyLimit) {
  const char* given = std::getenv("RAVE_RECORDINGS");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(RAVE_SOURCE_DIR).parent_path() / "shared" / "data";
  if (!std::filesystem::exists(folder / "carmen")) {
    GTEST_SKIP() << "the whole logs are not in " << folder
                 << "; RAVE_RECORDINGS names their folder";
  }
  expect_found_at_any_limit(written(folder / "carmen/freiburg-079-corrected.log.gz"), 81.91F);
  expect_found_at_any_limit(written(folder / "carmen/intel-corrected.log.gz"), 81.83F);
}

TEST(NoReturn, OneLongerRayDoesNotHideIt) {
  std::vector<float> ranges_m;
  for (int i = 0; i < 1000; ++i) {
    ranges_m.push_back(i % 5 == 0 ? 51.15F : 1.0F + 0.01F * static_cast<float>(i));
  }
  EXPECT_EQ(find_no_return(ranges_m, 80)->range_m, 51.15F);
  ranges_m[3] = 63;
  EXPECT_EQ(find_no_return(ranges_m, 80)->range_m, 51.15F);
  ranges_m[4] = std::numeric_limits<float>::quiet_NaN();
  ranges_m[6] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(find_no_return(ranges_m, 80)->range_m, 51.15F);
  EXPECT_EQ(find_no_return(ranges_m, 80)->of, 1000U);
}

TEST(NoReturn, AWallIsNone) {
  std::vector<float> still;  // a robot that stands: all scans are the same
  for (int i = 0; i < 1000; ++i) still.push_back(1.0F + 0.1F * static_cast<float>(i % 10));
  EXPECT_FALSE(find_no_return(still, 80));
  EXPECT_FALSE(find_no_return(std::vector<float>(1000, 2.5F), 80)) << "nothing to compare with";
  EXPECT_FALSE(find_no_return({}, 80));
  std::vector<float> few(1000, 1.0F);
  for (std::size_t i = 0; i < few.size(); ++i) few[i] += 0.003F * static_cast<float>(i);
  std::fill_n(few.begin(), 9, 20.0F);
  EXPECT_FALSE(find_no_return(few, 80)) << "nine rays show nothing";
  few[9] = 20.0F;
  EXPECT_TRUE(find_no_return(few, 80));
}

}  // namespace
}  // namespace rave::carmen
