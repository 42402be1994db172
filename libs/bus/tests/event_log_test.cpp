// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/event_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rave::bus {
namespace {

using std::chrono::milliseconds;

class LogLines final : public LogSink {
 public:
  void write(LogLevel level, std::string_view source, std::string_view message) override {
    lines.push_back(fmt::format("{} {}: {}", rave::to_string(level), source, message));
  }
  std::vector<std::string> lines;
};

BusEvent refusal(std::uint64_t writer, const std::string& why) {
  return {EventKind::kRefused, "rave/world", "", writer, why};
}

TEST(EventLog, WhoeverSendsWithoutEndDoesNotFillTheLog) {
  LogLines log;
  EventLog events(&log);
  const EventLog::Clock::time_point start{milliseconds(5000)};
  // Ten thousand lines a second for eight seconds, each another one, from ever new processes.
  for (int i = 0; i < 80'000; ++i) {
    events.note(refusal(static_cast<std::uint64_t>(1 + i % 7000), fmt::format("x_m is {}", i)),
                start + milliseconds(i / 10));
  }
  EXPECT_LE(log.lines.size(), EventLog::kAtOnce + 8);
  EXPECT_GE(log.lines.size(), EventLog::kAtOnce + 7);
  EXPECT_EQ(log.lines.front(), "warning bus: refused on rave/world (0000000000000001): x_m is 0");
  EXPECT_NE(log.lines.back().find("more lines about other processes were left out"),
            std::string::npos)
      << log.lines.back();
}

TEST(EventLog, TheSameEventOfAProcessIsWrittenOnce) {
  LogLines log;
  EventLog events(&log);
  for (int i = 0; i < 5; ++i) events.note(refusal(1, "x_m is nan"));
  events.note(refusal(2, "x_m is nan"));
  events.note(refusal(1, "y_m is nan"));
  events.note(refusal(1, "x_m is nan"));
  EXPECT_EQ(log.lines.size(), 4U);
  events.note({EventKind::kParticipantLost, "", "one", 1, ""});
  EXPECT_EQ(log.lines.size(), 4U);
}

TEST(EventLog, BytesOfOthersAreWrittenAsPrintableText) {
  LogLines log;
  EventLog events(&log);
  events.write(LogLevel::kError, "host",
               "a\x1b[2Jb \xff\xfe \xc0\xaf \xed\xa0\x80 gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(log.lines.back(), "error host: a?[2Jb ?? ? ? gr\xc3\xbc\xc3\x9f");
  events.write(LogLevel::kError, "host", std::string(100'000, 'x'));
  EXPECT_LT(log.lines.back().size(), EventLog::kMostBytes + 30);
}

TEST(EventLog, WithoutALogNothingIsWritten) {
  EventLog events(nullptr);
  events.note(refusal(1, "x_m is nan"));
  events.write(LogLevel::kError, "host", "text");
}

TEST(BusEvents, HaveNames) {
  for (int i = 0; i <= static_cast<int>(EventKind::kStoodStill); ++i) {
    EXPECT_NE(to_string(static_cast<EventKind>(i)), "unknown") << i;
  }
}

}  // namespace
}  // namespace rave::bus
