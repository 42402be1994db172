// SPDX-License-Identifier: Apache-2.0
// Live players follow the clock of the run, which here is moved by hand.
#include "played.hpp"

namespace rave::utias {
namespace {

/// How many of the samples are due at a moment.
template <class Record>
std::size_t due(const std::vector<Published<Record>>& all, std::int64_t now_ns) {
  std::size_t count = 0;
  while (count < all.size() && all[count].stamp_ns <= now_ns) ++count;
  return count;
}

template <class Record>
void expect_on_time(const std::string& driver) {
  Given given = {{"folder", "100-220"}, {"robot", 5.0}, {"end_s", 110.0}};
  const auto all = play_all<Record>(driver, given);
  ASSERT_GT(all.size(), 5U);
  given["clock"] = "live";
  Player player(driver);
  ASSERT_EQ(player.configure(given, data_folder()), "");
  RecordingSink<Record> sink;
  ASSERT_EQ(player.open(sink), "");
  sink.await_idle();
  EXPECT_TRUE(sink.published().empty()) << "the run has not begun";
  for (std::int64_t now_ns = 0; now_ns <= 10 * kSecond_ns; now_ns += 70 * kMillisecond_ns) {
    sink.set_now(now_ns);
    sink.await_idle();
    ASSERT_EQ(sink.published().size(), due(all, now_ns)) << now_ns;
  }
  sink.set_now(11 * kSecond_ns);
  sink.await_end();
  EXPECT_EQ(sink.published(), all);
  EXPECT_EQ(sink.fault(), "");
  sink.close();
  player.close();
}

TEST(Live, NothingComesBeforeItIsDue) {
  expect_on_time<PoseReading>("utias_mocap");
  expect_on_time<VelocityReading>("utias_odometry");
  expect_on_time<rave::Sighting>("utias_camera");
}

TEST(Live, ClosingEndsAWaitForTheClock) {
  Player player("utias_mocap");
  const Given given = {{"folder", "100-220"}, {"robot", 3.0}, {"clock", "live"}};
  ASSERT_EQ(player.configure(given, data_folder()), "");
  RecordingSink<PoseReading> sink;
  ASSERT_EQ(player.open(sink), "");
  sink.set_now(kSecond_ns);
  sink.await_idle();
  sink.close();
  player.close();
  EXPECT_NE(sink.complete_ns(), kForever_ns) << "the recording has not ended";
  EXPECT_FALSE(sink.published().empty());
}

}  // namespace
}  // namespace rave::utias
