// SPDX-License-Identifier: Apache-2.0
// Opening, closing and opening again. A player that does not end hangs the test.
#include <memory>
#include <thread>

#include "played.hpp"

namespace rave::utias {
namespace {

const Given kRobotThree = {{"folder", "100-220"}, {"robot", 3.0}};

TEST(Threads, ClosedInMidStreamFromAnotherThread) {
  Player player("utias_mocap");
  ASSERT_EQ(player.configure(kRobotThree, data_folder()), "");
  RecordingSink<PoseReading> sink(500);
  ASSERT_EQ(player.open(sink), "");
  sink.await_blocked();
  std::thread([&] {
    sink.close();
    player.close();
  }).join();
  EXPECT_EQ(sink.published().size(), 500U);
  EXPECT_NE(sink.complete_ns(), kForever_ns);
  EXPECT_EQ(sink.fault(), "");
}

TEST(Threads, ItPromisesTheTimeUpToTheSampleThatFindsNoRoom) {
  const auto all = play_all<rave::Sighting>("utias_camera", kRobotThree);
  Player player("utias_camera");
  ASSERT_EQ(player.configure(kRobotThree, data_folder()), "");
  RecordingSink<rave::Sighting> sink(10);
  ASSERT_EQ(player.open(sink), "");
  sink.await_blocked();
  EXPECT_EQ(sink.complete_ns(), all[10].stamp_ns - 1)
      << "a host that waits for a moment before that would wait for ever";
  sink.close();
  player.close();
}

template <class Record>
void expect_the_same_again(const std::string& driver) {
  Player player(driver);
  ASSERT_EQ(player.configure(kRobotThree, data_folder()), "");
  const auto first = play_once<Record>(player);
  ASSERT_FALSE(first.empty());
  {
    RecordingSink<Record> broken_off(20);
    ASSERT_EQ(player.open(broken_off), "");
    broken_off.await_blocked();
    broken_off.close();
    player.close();
  }
  EXPECT_EQ(play_once<Record>(player), first);
}

TEST(Threads, OpenedAgainItGivesTheSame) {
  expect_the_same_again<PoseReading>("utias_mocap");
  expect_the_same_again<VelocityReading>("utias_odometry");
  expect_the_same_again<rave::Sighting>("utias_camera");
}

TEST(Threads, DestroyedWithoutClosingItEndsToo) {
  RecordingSink<PoseReading> sink(5);
  {
    Player player("utias_mocap");
    ASSERT_EQ(player.configure(kRobotThree, data_folder()), "");
    ASSERT_EQ(player.open(sink), "");
    sink.await_blocked();
    sink.close();
  }
  EXPECT_EQ(sink.published().size(), 5U);
}

TEST(Threads, OpenOutOfOrderIsRefused) {
  RecordingSink<PoseReading> sink;
  Player player("utias_mocap");
  EXPECT_EQ(player.open(sink), "opened before it was configured");
  player.close();
  ASSERT_EQ(player.configure(kRobotThree, data_folder()), "");
  ASSERT_EQ(player.open(sink), "");
  EXPECT_EQ(player.open(sink), "opened twice; close it first");
  sink.close();
  player.close();
  player.close();
}

}  // namespace
}  // namespace rave::utias
