// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/run_words.hpp"

#include <gtest/gtest.h>

#include "rave/bus/sequence.hpp"

namespace rave::lock_step {
namespace {

RunWord word(std::uint64_t writer, rave_wire_RunPhase phase, std::string text = {}) {
  return {writer, phase, std::move(text), false};
}

TEST(RunWords, OnlyWhoFitsIsListenedTo) {
  RunWords words;
  words.hear(word(1, rave_wire_RUN_FAILED));
  EXPECT_TRUE(words.take().empty()) << "nobody knows it";
  words.shut_out(1);
  words.hear(word(1, rave_wire_RUN_FAILED));
  words.welcome(1);
  EXPECT_TRUE(words.take().empty()) << "it does not fit, whatever it says later";
  words.welcome(2);
  words.hear(word(2, rave_wire_RUN_ENDED, "done"));
  const auto heard = words.take();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].writer, 2U);
  EXPECT_EQ(heard[0].phase, rave_wire_RUN_ENDED);
  EXPECT_EQ(heard[0].text, "done");
  EXPECT_TRUE(words.take().empty()) << "once";
}

TEST(RunWords, AWordThatCameBeforeTheIntroductionIsNotLost) {
  RunWords words;
  words.hear(word(7, rave_wire_RUN_GATHERING));
  words.hear(word(7, rave_wire_RUN_ENDED));
  EXPECT_TRUE(words.take().empty());
  words.welcome(7);
  const auto heard = words.take();
  ASSERT_EQ(heard.size(), 1U) << "the newest of each";
  EXPECT_EQ(heard[0].phase, rave_wire_RUN_ENDED);
}

TEST(RunWords, ACrowdOfUnknownDoesNotKeepTheManagerFromBeingHeard) {
  RunWords words;
  words.welcome(1);
  for (std::uint64_t writer = 2; writer < 500; ++writer) {
    words.hear(word(writer, rave_wire_RUN_FAILED));
  }
  words.hear(word(1, rave_wire_RUN_RUNNING));
  const auto heard = words.take();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].writer, 1U);
}

TEST(RunWords, SayWhetherTheHostWasDropped) {
  std::vector<rave_wire_HostSight> hosts(2);
  hosts[0].host = 3;
  hosts[0].phase = rave_wire_HOST_DROPPED;
  hosts[1].host = 4;
  hosts[1].phase = rave_wire_HOST_RUNS;
  bus::RunState state{};
  state.writer = 9;
  state.phase = rave_wire_RUN_RUNNING;
  bus::borrow(state.hosts, hosts);
  EXPECT_TRUE(run_word(state, 3).without_us);
  EXPECT_FALSE(run_word(state, 4).without_us);
  EXPECT_FALSE(run_word(state, 5).without_us);
  EXPECT_EQ(run_word(state, 3).writer, 9U);
}

}  // namespace
}  // namespace rave::lock_step
