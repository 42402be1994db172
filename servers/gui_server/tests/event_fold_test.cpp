// SPDX-License-Identifier: Apache-2.0
#include "run/event_fold.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rave/sim/event.hpp"

namespace rave::gui_server {
namespace {

TEST(EventFold, ContactsOfTwoRobotsAreOneRow) {
  EventFold fold({"hunter", "real-3"});
  for (int i = 0; i < 131; ++i) {
    fold.add(31.28 + 0.05 * i, i % 2, "contact", i % 2 == 0 ? "with real-3 " : "with hunter ");
  }
  ASSERT_EQ(fold.events().size(), 1U);
  const LogEvent& event = fold.events().front();
  EXPECT_EQ(event.count, 131U);
  EXPECT_EQ(event.text, "hunter and real-3 touch");
  EXPECT_EQ(event.slots, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_DOUBLE_EQ(event.t_s, 31.28);
  EXPECT_DOUBLE_EQ(event.until_s, 31.28 + 0.05 * 130);
}

TEST(EventFold, WhatComesAgainLaterIsAnotherRow) {
  EventFold fold({"real-1"});
  fold.add(1, 0, "pose stale", "its last pose is from 0.5 s");
  fold.add(20, 0, "pose stale", "its last pose is from 0.5 s");
  ASSERT_EQ(fold.events().size(), 2U);
  EXPECT_EQ(fold.events()[0].level, LogEvent::Level::kWarn);
  EXPECT_EQ(fold.events()[0].text, "real-1: pose stale, its last pose is from 0.5 s");
}

/// The kinds are those of the engine: a word that it does not use would never match.
TEST(EventFold, KindsThatNeedAttentionStandOut) {
  EventFold fold({"real-1"});
  for (const sim::EventKind kind :
       {sim::EventKind::kHandOverRefused, sim::EventKind::kChangeRefused, sim::EventKind::kStopped,
        sim::EventKind::kPoseStale}) {
    fold.add(1, 0, sim::to_string(kind), "");
    EXPECT_EQ(fold.events().back().level, LogEvent::Level::kWarn) << sim::to_string(kind);
  }
  for (const sim::EventKind kind :
       {sim::EventKind::kProgramFailed, sim::EventKind::kDriverFailed, sim::EventKind::kPinned}) {
    fold.add(1, 0, sim::to_string(kind), "");
    EXPECT_EQ(fold.events().back().level, LogEvent::Level::kAlert) << sim::to_string(kind);
  }
}

TEST(EventFold, EventsOfTheWorldHaveNoRobot) {
  EventFold fold({"real-1"});
  fold.add(1, -1, "obstacle added", "`box` at 1, 2");
  EXPECT_TRUE(fold.events()[0].slots.empty());
  EXPECT_EQ(fold.events()[0].text, "obstacle added: `box` at 1, 2");
}

TEST(EventFold, ALogThatIsFullSaysWhatIsLeftOut) {
  EventFold fold({"a"});
  for (std::size_t i = 0; i < EventFold::kMostEvents + 10; ++i) {
    fold.add(static_cast<double>(i), 0, "changed", fmt::format("number {}", i));
  }
  ASSERT_EQ(fold.events().size(), EventFold::kMostEvents + 1);
  EXPECT_EQ(fold.events().back().text,
            "the log is full: 10 more events are not shown; the recording has them");
  const std::uint64_t revision = fold.revision();
  // What matters is still told.
  fold.add(1e6, 0, "driver failed", "it does not answer");
  EXPECT_EQ(fold.events().size(), EventFold::kMostEvents + 2);
  EXPECT_EQ(fold.events().back().level, LogEvent::Level::kAlert);
  EXPECT_EQ(fold.changed_since(revision), EventFold::kMostEvents + 1);
  fold.add(2e6, 0, "changed", "one more");
  EXPECT_EQ(fold.events().size(), EventFold::kMostEvents + 2);
  EXPECT_TRUE(fold.events()[EventFold::kMostEvents].text.starts_with("the log is full: 11 more"));
}

}  // namespace
}  // namespace rave::gui_server
