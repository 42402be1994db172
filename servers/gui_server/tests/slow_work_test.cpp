// SPDX-License-Identifier: Apache-2.0
#include "people/slow_work.hpp"

#include <gtest/gtest.h>

#include <future>
#include <string>
#include <vector>

namespace rave::gui_server {
namespace {

/// Holds the thread until it is told to go on.
class Gate {
 public:
  explicit Gate(SlowWork& work) {
    EXPECT_TRUE(work.post([this] {
      reached_.set_value();
      open_.get_future().wait();
    }));
    reached_.get_future().wait();
  }
  void open() { open_.set_value(); }

 private:
  std::promise<void> reached_;
  std::promise<void> open_;
};

TEST(SlowWorkTest, QueuesTakeTurnsAndTheServersOwnComesFirst) {
  SlowWork work;
  Gate gate(work);
  std::string order;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(work.post([&order] { order += 'a'; }, "10.0.0.1"));
  std::promise<void> last;
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(work.post([&order] { order += 'b'; }, "10.0.0.2"));
  EXPECT_TRUE(work.post([&order] { order += 's'; }));
  EXPECT_TRUE(work.post([&last] { last.set_value(); }, "10.0.0.1"));
  gate.open();
  last.get_future().wait();
  EXPECT_EQ(order, "sababaaa");
}

TEST(SlowWorkTest, AFullQueueLeavesRoomForOthers) {
  SlowWork work;
  Gate gate(work);
  int taken = 0;
  while (work.post([] {}, "10.0.0.1")) ++taken;
  EXPECT_EQ(taken, 32);
  EXPECT_TRUE(work.post([] {}, "10.0.0.2"));
  EXPECT_TRUE(work.post([] {}));
  // Those of many networks are bounded, too, and not by what the server itself does.
  for (int i = 3; i < 10; ++i) {
    while (work.post([] {}, "10.0.0." + std::to_string(i))) ++taken;
  }
  EXPECT_EQ(taken, 127);
  EXPECT_TRUE(work.post([] {}));
  gate.open();
  work.stop();
  EXPECT_FALSE(work.post([] {}));
}

}  // namespace
}  // namespace rave::gui_server
