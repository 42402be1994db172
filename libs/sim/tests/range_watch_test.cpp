// SPDX-License-Identifier: Apache-2.0
#include "../src/range_watch.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "live_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// A laser of 36 rays all round, each in a sector of its own.
class RangeWatchTest : public ::testing::Test {
 protected:
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  static constexpr float kFree = std::numeric_limits<float>::infinity();

  RangeWatchTest() {
    SensorInfo info;
    info.kind = ReadingKind::kRanges;
    info.capacity = 36;
    info.X_RS = {0.1, 0, 0.5 * kPi};  // it looks to the left
    for (int i = 0; i < 36; ++i) bearings_rad_.push_back(i * kPi / 18 - kPi);
    info.bearings_rad = bearings_rad_.data();
    watch_.emplace(LiveRanges{2, &queue_, ray_sectors(info)}, 0.5);
  }
  void say(const std::vector<float>& ranges_m) {
    clock_.advance(0.1);
    ASSERT_TRUE(
        queue_.publish(clock_.now(), ranges_m.data(), static_cast<std::uint32_t>(ranges_m.size())));
    watch_->update();
    watch_->update();  // the same sample is no second one
    watch_->frozen().note_told({0.5, 0, 0}, 0.1);
  }
  [[nodiscard]] Sectors blind() const {
    Sight sight;
    watch_->add_to(sight);
    return sight.blind();
  }

  HandClock clock_;
  SampleQueue queue_{ReadingKind::kRanges, 36, 16, &clock_};
  std::vector<double> bearings_rad_;
  std::optional<RangeWatch> watch_;
};

TEST_F(RangeWatchTest, IsBlindInTheDirectionsOfTheRobot) {
  EXPECT_FALSE(blind().any()) << "nothing was said yet";
  std::vector<float> ranges_m(36, 2.0F);
  say(ranges_m);
  EXPECT_FALSE(blind().any());
  ranges_m[9] = kUnknown;  // at -90 degrees of the sensor
  say(ranges_m);
  EXPECT_TRUE(blind().any());
  EXPECT_EQ(blind() - Sectors::ahead(0.05), Sectors());
  ranges_m[9] = kFree;
  say(ranges_m);
  EXPECT_FALSE(blind().any());
}

TEST_F(RangeWatchTest, AScanThatIsSentAgainIsFrozen) {
  const std::vector<float> ranges_m(36, 2.0F);
  for (int i = 0; i < 4; ++i) say(ranges_m);
  EXPECT_FALSE(watch_->frozen().is_frozen());
  for (int i = 0; i < 4; ++i) say(ranges_m);
  EXPECT_TRUE(watch_->frozen().is_frozen());
  std::vector<float> other = ranges_m;
  other[35] = 2.001F;
  say(other);
  EXPECT_FALSE(watch_->frozen().is_frozen());
}

TEST_F(RangeWatchTest, FreeSpaceLooksTheSameEverywhere) {
  std::vector<float> ranges_m(36, kFree);
  for (int i = 0; i < 7; ++i) ranges_m[static_cast<std::size_t>(i)] = 1.0F;
  for (int i = 0; i < 100; ++i) say(ranges_m);
  EXPECT_FALSE(watch_->frozen().is_frozen());
  ranges_m[7] = 1.0F;
  for (int i = 0; i < 10; ++i) say(ranges_m);
  EXPECT_TRUE(watch_->frozen().is_frozen());
}

}  // namespace
}  // namespace rave::sim::testing
