// SPDX-License-Identifier: Apache-2.0
// What a queue of samples does not take.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <string_view>

#include "sample_queue_support.hpp"

namespace rave {
namespace {

class StillClock final : public RunClock {
 public:
  [[nodiscard]] SimTime now() const noexcept override { return {now_ns}; }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime) const noexcept override {
    return {};
  }
  std::int64_t now_ns = 0;
};

TEST(SampleQueue, DropsStampsThatStepBackAndRemembersTheFirst) {
  SampleQueue queue = values(4);
  put(queue, 2'000'000'000, 0);
  EXPECT_TRUE(put(queue, 1'500'000'000, 0));
  EXPECT_TRUE(put(queue, 1'000'000'000, 0));
  EXPECT_TRUE(put(queue, 2'000'000'000, 0));
  EXPECT_EQ(queue.dropped(), 2U);
  EXPECT_EQ(queue.complaint(),
            "the sample of 1.500000000 s was dropped: it came after one of 2.000000000 s; stamps "
            "must not step back");
  EXPECT_EQ(take(queue, kEnd), (Stamps{2'000'000'000, 2'000'000'000}));
}

TEST(SampleQueue, DropsSamplesInTimeThatWasSaidToBeComplete) {
  SampleQueue queue = values(4);
  queue.complete_up_to({1'000'000'000});
  EXPECT_TRUE(put(queue, 1'000'000'000, 0));
  EXPECT_TRUE(put(queue, 1'000'000'001, 0));
  EXPECT_EQ(queue.complaint(),
            "the sample of 1.000000000 s was dropped: it came after the driver had declared "
            "samples complete up to 1.000000000 s");
  EXPECT_EQ(take(queue, kEnd), Stamps{1'000'000'001});
}

TEST(SampleQueue, AStreamThatIsLiveCanRecoverAndAnotherCannot) {
  SampleQueue stepped = values(4);
  stepped.fail("gone", 4);
  stepped.recover();
  EXPECT_EQ(stepped.failure(), "gone");
  const StillClock clock{};
  SampleQueue live(ReadingKind::kValues, 2, 4, &clock);
  live.fail("gone", 4);
  EXPECT_EQ(live.wait_complete({0}, std::chrono::milliseconds(0)), SampleQueue::Wait::kFailed);
  live.recover();
  EXPECT_EQ(live.failure(), "");
  EXPECT_EQ(live.wait_complete({0}, std::chrono::milliseconds(0)), SampleQueue::Wait::kComplete);
  live.fail("gone again", 10);
  EXPECT_EQ(live.failure(), "gone again");
}

TEST(SampleQueue, TellsWhenTheNewestSampleWasTrue) {
  const StillClock clock{};
  SampleQueue queue(ReadingKind::kValues, 1, 4, &clock);
  EXPECT_EQ(queue.newest_moment(), std::nullopt);
  const double value = 1;
  const auto before = std::chrono::steady_clock::now();
  // From the future by its stamp: not younger than its arrival.
  ASSERT_TRUE(queue.publish({5}, &value, 1));
  EXPECT_EQ(queue.newest_lag().ns, 0);
  const auto first = queue.newest_moment();
  ASSERT_TRUE(first);
  EXPECT_GE(*first, before);
  EXPECT_LE(*first, std::chrono::steady_clock::now());
  ASSERT_TRUE(queue.publish({4}, &value, 1));
  EXPECT_EQ(queue.newest_moment(), first) << "one that is dropped is no sign of life";
  EXPECT_FALSE(queue.failed());
  queue.fail("gone", 4);
  EXPECT_TRUE(queue.failed());
  queue.reopen();
  EXPECT_EQ(queue.newest_moment(), std::nullopt);
  EXPECT_FALSE(queue.failed());
}

TEST(SampleQueue, WhatComesLateIsOldWhenItComes) {
  StillClock clock{};
  clock.now_ns = 5'000'000'000;
  SampleQueue queue(ReadingKind::kValues, 1, 4, &clock);
  const double value = 1;
  const auto before = std::chrono::steady_clock::now();
  ASSERT_TRUE(queue.publish({2'000'000'000}, &value, 1));
  EXPECT_EQ(queue.newest_lag().seconds(), 3);
  EXPECT_GE(*queue.newest_moment(), before - std::chrono::seconds(3));
  EXPECT_LE(*queue.newest_moment(), std::chrono::steady_clock::now() - std::chrono::seconds(3));
}

/// Refuses what is below 0, and calls what is above 9 something new.
class SignGate final : public SampleGate {
 public:
  Verdict judge(SimTime, const void* record) override {
    last_ = *static_cast<const double*>(record);
    return last_ < 0 ? Verdict::kRefuse : last_ > 9 ? Verdict::kAnew : Verdict::kPass;
  }
  [[nodiscard]] std::string reason() const override { return fmt::format("it was {}", last_); }
  void reset() noexcept override { last_ = 0; }

 private:
  double last_ = 0;
};

TEST(SampleQueue, WhatItsGateRefusesCountsForNothing) {
  SampleQueue queue(ReadingKind::kValues, 1, 8, nullptr, std::make_unique<SignGate>());
  std::int64_t stamp_ns = 0;
  for (const double value : {1.0, -2.0, -3.0, 10.0, 4.0}) {
    ASSERT_TRUE(queue.publish({++stamp_ns}, &value, 1));
  }
  EXPECT_EQ(queue.refusal(), "it was -3");
  EXPECT_EQ(queue.break_reason(), "it was 10");
  EXPECT_EQ(queue.latest(), (SampleQueue::Before{1, 2}));
  SampleHeader header;
  double value = 0;
  // What happened belongs to the sample that follows it, however far the producer is ahead.
  ASSERT_TRUE(queue.next({9}, &header, &value));
  EXPECT_EQ(queue.before(), (SampleQueue::Before{0, 0}));
  ASSERT_TRUE(queue.next({9}, &header, &value));
  EXPECT_EQ(value, 10);
  EXPECT_EQ(header.dropped, 0U);
  EXPECT_EQ(queue.before(), (SampleQueue::Before{1, 2}));
  queue.reopen();
  EXPECT_EQ(queue.latest(), SampleQueue::Before{});
  EXPECT_EQ(queue.break_reason(), "");
}

TEST(SampleQueue, ADriverMaySayThatItBeginsAnew) {
  const StillClock clock{};
  SampleQueue queue(ReadingKind::kValues, 1, 4, &clock);
  queue.begin_anew("clock set", 9);
  EXPECT_EQ(queue.latest().breaks, 1U);
  EXPECT_EQ(queue.before().breaks, 0U);
  EXPECT_EQ(queue.break_reason(), "clock set");
  SampleQueue stepped = values(4);
  stepped.begin_anew("clock set", 9);
  EXPECT_EQ(stepped.latest().breaks, 0U) << "a recording has no such clock";
}

TEST(SampleQueue, DropsSamplesThatDoNotFit) {
  SampleQueue queue = values(4);
  const double records[3] = {1, 2, 3};
  EXPECT_TRUE(queue.publish({0}, records, 3));
  EXPECT_EQ(queue.complaint(),
            "the sample of 0.000000000 s was dropped: it holds 3 records, more than the 2 that "
            "were declared");
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_TRUE(queue.publish({0}, records, 2));
  SampleHeader header;
  double out[2];
  ASSERT_TRUE(queue.next({0}, &header, out));
  EXPECT_EQ(header.dropped, 3U);  // records
  EXPECT_EQ(header.sequence, 1U);
}

}  // namespace
}  // namespace rave
