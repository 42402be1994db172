// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string_view>
#include <thread>

#include "sample_queue_support.hpp"

namespace rave {
namespace {

using Wait = SampleQueue::Wait;
using Clock = std::chrono::steady_clock;

// Far beyond what any test needs: a wait that ends by it has failed.
constexpr std::chrono::milliseconds kLong{100'000};
constexpr std::chrono::milliseconds kNone{0};
constexpr SimTime kEnd{INT64_MAX};

/// A clock that the test moves, and that knows when the producer has asked it.
class TestClock final : public RunClock {
 public:
  [[nodiscard]] SimTime now() const noexcept override { return {now_ns.load()}; }
  [[nodiscard]] Clock::time_point wall_time_of(SimTime) const noexcept override {
    asked.store(true);
    asked.notify_all();
    return paused.load() ? Clock::time_point::max() : Clock::time_point{};  // long past
  }
  std::atomic<std::int64_t> now_ns = 0;
  std::atomic<bool> paused = true;
  mutable std::atomic<bool> asked = false;
};

TEST(SampleQueue, TellsTheTimeOfALiveRunOnly) {
  TestClock clock;
  clock.now_ns = 1234;
  EXPECT_EQ(values(1, &clock).now(), SimTime{1234});
  EXPECT_EQ(values(1).now(), SimTime{INT64_MIN});
}

TEST(SampleQueue, HandsOverManySamplesInOrder) {
  constexpr std::int64_t kSamples = 100'000;
  constexpr std::int64_t kStep_ns = 7;
  SampleQueue queue = values(8);
  std::thread producer([&] {
    for (std::int64_t i = 0; i < kSamples; ++i) {
      const double records[2] = {static_cast<double>(i), -static_cast<double>(i)};
      EXPECT_TRUE(queue.publish({i}, records, 2));
    }
    queue.complete_up_to(kEnd);
  });
  std::int64_t expected = 0;
  for (std::int64_t end_ns = kStep_ns - 1; expected < kSamples; end_ns += kStep_ns) {
    Wait wait = Wait::kFull;
    while (wait == Wait::kFull) {
      wait = queue.wait_complete({end_ns}, kLong);
      SampleHeader header;
      double records[2];
      while (queue.next({end_ns}, &header, records)) {
        EXPECT_EQ(header.stamp_ns, expected);
        EXPECT_EQ(header.sequence, expected + 1);
        EXPECT_EQ(header.count, 2U);
        EXPECT_EQ(header.dropped, 0U);
        EXPECT_EQ(records[0], static_cast<double>(expected));
        EXPECT_EQ(records[1], -static_cast<double>(expected));
        ++expected;
      }
    }
    // Complete means complete: the whole interval has come out.
    ASSERT_EQ(wait, Wait::kComplete);
    ASSERT_EQ(expected, std::min(end_ns + 1, kSamples));
  }
  producer.join();
  EXPECT_EQ(queue.dropped(), 0U);
  EXPECT_EQ(queue.complaint(), "");
}

TEST(SampleQueue, HandsOverManySamplesLive) {
  constexpr std::int64_t kSamples = 100'000;
  TestClock clock;
  SampleQueue queue = values(8, &clock);
  std::atomic<bool> done = false;
  std::thread producer([&] {
    for (std::int64_t i = 0; i < kSamples; ++i) EXPECT_TRUE(put(queue, i, 1.0));
    done.store(true);
  });
  std::int64_t taken = 0;
  std::uint64_t dropped = 0;
  std::uint32_t before = 0;
  for (bool last = false; !last;) {
    last = done.load();
    SampleHeader header;
    double records[2];
    while (queue.next(kEnd, &header, records)) {
      ++taken;
      dropped += header.dropped;
      ASSERT_EQ(header.sequence, before + header.dropped + 1);
      ASSERT_EQ(header.stamp_ns, header.sequence - 1);
      before = header.sequence;
    }
  }
  producer.join();
  EXPECT_EQ(before, kSamples);
  EXPECT_EQ(dropped, queue.dropped());
  EXPECT_EQ(taken + static_cast<std::int64_t>(dropped), kSamples);
}

TEST(SampleQueue, HoldsTheProducerBackWhenItIsFull) {
  SampleQueue queue = values(4);
  std::atomic<int> published = 0;
  std::thread producer([&] {
    for (int i = 0; i < 10; ++i) {
      EXPECT_TRUE(put(queue, i, 0));
      ++published;
    }
    queue.complete_up_to(kEnd);
  });
  EXPECT_EQ(queue.wait_complete(kEnd, kLong), Wait::kFull);
  EXPECT_LE(published.load(), 4);
  // One sample taken wakes nobody; waiting does, so that the queue fills again.
  SampleHeader header;
  double records[2];
  ASSERT_TRUE(queue.next(kEnd, &header, records));
  EXPECT_EQ(queue.wait_complete(kEnd, kLong), Wait::kFull);
  EXPECT_LE(published.load(), 5);
  Stamps stamps;
  Wait wait = Wait::kFull;
  while (wait == Wait::kFull) {
    for (const std::int64_t stamp : take(queue, kEnd)) stamps.push_back(stamp);
    wait = queue.wait_complete(kEnd, kLong);
  }
  EXPECT_EQ(wait, Wait::kComplete);
  for (const std::int64_t stamp : take(queue, kEnd)) stamps.push_back(stamp);
  EXPECT_EQ(stamps, (Stamps{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  producer.join();
}

TEST(SampleQueue, GivesOnlyWhatIsDue) {
  SampleQueue queue = values(8);
  for (const int stamp : {10, 20, 20, 30}) put(queue, stamp, 0);
  EXPECT_EQ(take(queue, {9}), Stamps{});
  EXPECT_EQ(take(queue, {20}), (Stamps{10, 20, 20}));
  EXPECT_EQ(take(queue, {29}), Stamps{});
  EXPECT_EQ(take(queue, {30}), Stamps{30});
}

TEST(SampleQueue, ALaterStampProvesCompleteness) {
  SampleQueue queue = values(2);
  EXPECT_EQ(queue.wait_complete({10}, kNone), Wait::kTimeout);
  put(queue, 10, 0);
  EXPECT_EQ(queue.wait_complete({10}, kNone), Wait::kTimeout);  // a second one of 10 may come
  put(queue, 11, 0);
  EXPECT_EQ(queue.wait_complete({10}, kNone), Wait::kComplete);  // although it is full
  EXPECT_EQ(queue.wait_complete({11}, kNone), Wait::kFull);
  EXPECT_EQ(take(queue, kEnd), (Stamps{10, 11}));
  EXPECT_EQ(queue.wait_complete({10}, kNone), Wait::kComplete);  // although it is empty
  EXPECT_EQ(queue.wait_complete({11}, kNone), Wait::kTimeout);
  queue.complete_up_to({11});
  queue.complete_up_to({5});  // no promise is taken back
  EXPECT_EQ(queue.wait_complete({11}, kNone), Wait::kComplete);
  EXPECT_EQ(queue.wait_complete({12}, kNone), Wait::kTimeout);
}

TEST(SampleQueue, APromiseWakesTheConsumer) {
  SampleQueue queue = values(2);
  std::thread producer([&] { queue.complete_up_to({5}); });
  EXPECT_EQ(queue.wait_complete({5}, kLong), Wait::kComplete);
  producer.join();
}

TEST(SampleQueue, AFailureWakesTheConsumerAndKeepsItsText) {
  SampleQueue queue = values(2);
  put(queue, 5, 0);
  queue.complete_up_to({5});
  std::thread producer([&] {
    constexpr std::string_view kText = "the cable is out";
    queue.fail(kText.data(), kText.size());
    queue.fail("later", 5);
  });
  EXPECT_EQ(queue.wait_complete({6}, kLong), Wait::kFailed);
  producer.join();
  EXPECT_EQ(queue.failure(), "the cable is out");
  // What was complete before stays so, whenever the failure came.
  EXPECT_EQ(queue.wait_complete({5}, kNone), Wait::kComplete);
  EXPECT_EQ(take(queue, {5}), Stamps{5});
}

TEST(SampleQueue, CloseFreesAProducerThatWaitsForRoom) {
  SampleQueue queue = values(3);
  std::atomic<int> accepted = 0;
  std::thread producer([&] {
    while (put(queue, accepted, 0)) ++accepted;
    EXPECT_FALSE(put(queue, 100, 0));
    EXPECT_FALSE(queue.wait_until({0}));
  });
  ASSERT_EQ(queue.wait_complete(kEnd, kLong), Wait::kFull);
  queue.close();
  producer.join();
  EXPECT_EQ(accepted.load(), 3);
  EXPECT_EQ(queue.wait_complete(kEnd, kNone), Wait::kFailed);
  EXPECT_EQ(queue.failure(), "");
  EXPECT_EQ(take(queue, kEnd), (Stamps{0, 1, 2}));
}

TEST(SampleQueue, CloseFreesAProducerThatWaitsForItsTime) {
  TestClock clock;
  SampleQueue queue = values(3, &clock);
  bool due = true;
  std::thread producer([&] { due = queue.wait_until({10}); });
  clock.asked.wait(false);  // it asks while it holds the lock, so close() finds it asleep
  queue.close();
  producer.join();
  EXPECT_FALSE(due);
}

TEST(SampleQueue, APausedClockHoldsTheProducerUntilItGoesOn) {
  TestClock clock;
  SampleQueue queue = values(3, &clock);
  std::atomic<bool> due = false;
  std::thread producer([&] { due = queue.wait_until({10}); });
  clock.asked.wait(false);
  clock.now_ns = 9;
  clock.asked = false;
  queue.clock_changed();
  clock.asked.wait(false);  // it woke, saw that it is too early and sleeps again
  EXPECT_FALSE(due.load());
  clock.now_ns = 10;
  queue.clock_changed();
  producer.join();
  EXPECT_TRUE(due.load());
}

TEST(SampleQueue, WaitUntilEndsByTheWallClock) {
  TestClock clock;
  clock.paused = false;
  SampleQueue queue = values(3, &clock);
  EXPECT_TRUE(queue.wait_until({1}));
  EXPECT_TRUE(clock.asked.load());
}

TEST(SampleQueue, WaitUntilIsDueAtOnceInASteppedRun) {
  SampleQueue queue = values(3);
  EXPECT_TRUE(queue.wait_until(kEnd));
}

TEST(SampleQueue, ReopensAsNew) {
  SampleQueue queue = values(2);
  put(queue, 50, 1);
  put(queue, 40, 1);
  put(queue, 60, 1);
  queue.complete_up_to({1000});
  queue.fail("gone", 4);
  queue.close();
  queue.reopen();
  EXPECT_EQ(queue.failure(), "");
  EXPECT_EQ(queue.complaint(), "");
  EXPECT_EQ(queue.dropped(), 0U);
  EXPECT_EQ(take(queue, kEnd), Stamps{});
  EXPECT_EQ(queue.wait_complete({5}, kNone), Wait::kTimeout);
  EXPECT_TRUE(put(queue, 5, 1));
  SampleHeader header;
  double records[2];
  ASSERT_TRUE(queue.next({5}, &header, records));
  EXPECT_EQ(header.sequence, 1U);
  EXPECT_EQ(header.dropped, 0U);
}

TEST(SampleQueue, LivePublishingLosesTheOldest) {
  TestClock clock;
  SampleQueue queue = values(3, &clock);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(put(queue, i, i));
  EXPECT_EQ(queue.dropped(), 2U);
  SampleHeader header;
  double records[2];
  ASSERT_TRUE(queue.next(kEnd, &header, records));
  EXPECT_EQ(header.stamp_ns, 2);
  EXPECT_EQ(header.sequence, 3U);
  EXPECT_EQ(header.dropped, 2U);
  EXPECT_EQ(records[0], 2);
  ASSERT_TRUE(queue.next(kEnd, &header, records));
  EXPECT_EQ(header.dropped, 0U);
  EXPECT_EQ(queue.complaint(), "");  // a full queue is no breach of the contract
}

TEST(SampleQueue, TheNewestSampleCanBeLookedAtBeforeItIsGivenOutAndAfter) {
  for (const std::size_t depth : {1U, 2U, 3U}) {
    TestClock clock;
    SampleQueue queue(ReadingKind::kValues, 2, depth, &clock);
    SampleHeader header;
    double value = 0;
    EXPECT_FALSE(queue.newest(&header, &value));
    std::array<double, 2> taken{};
    for (int k = 1; k <= 10; ++k) {
      const std::array<double, 2> pair{1.0 * k, -1.0};
      ASSERT_TRUE(queue.publish(SimTime{k}, pair.data(), 2));
      ASSERT_TRUE(queue.newest(&header, &value));
      EXPECT_EQ(header.stamp_ns, k);
      EXPECT_EQ(header.count, 2U);
      EXPECT_EQ(value, k) << "the first record of the sample";
      // The engine may be behind, and may have taken all.
      while (k % 2 == 0 && queue.next(SimTime{k}, &header, taken.data())) {
      }
      ASSERT_TRUE(queue.newest(&header, &value));
      EXPECT_EQ(header.stamp_ns, k);
      EXPECT_EQ(value, k);
    }
    // What was refused was not taken in.
    const double late = 0;
    ASSERT_TRUE(queue.publish(SimTime{3}, &late, 1));
    ASSERT_TRUE(queue.newest(&header, &value));
    EXPECT_EQ(header.stamp_ns, 10);
    queue.close();
    queue.reopen();
    EXPECT_FALSE(queue.newest(&header, &value));
  }
}

TEST(SampleQueue, ALiveRunNeverWaits) {
  TestClock clock;
  SampleQueue queue = values(3, &clock);
  EXPECT_EQ(queue.wait_complete(kEnd, kLong), Wait::kComplete);
  queue.fail("gone", 4);
  EXPECT_EQ(queue.wait_complete(kEnd, kLong), Wait::kFailed);
}

TEST(SampleQueue, TakesSamplesWithoutRecords) {
  SampleQueue queue = values(2);
  EXPECT_TRUE(queue.publish({3}, nullptr, 0));
  SampleHeader header;
  ASSERT_TRUE(queue.next({3}, &header, nullptr));
  EXPECT_EQ(header.count, 0U);
}

}  // namespace
}  // namespace rave
