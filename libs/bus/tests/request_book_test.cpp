// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/request_book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "rave/bus/request_parts.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {
namespace {

using std::chrono::seconds;
using Replies = std::vector<RequestBook::Reply>;

struct Lines final : LogSink {
  void write(LogLevel, std::string_view, std::string_view message) override {
    lines.emplace_back(message);
  }
  std::vector<std::string> lines;
};

/// A process that answers at once with what it was asked, but `wait` only when it is let.
class RequestBookTest : public ::testing::Test {
 protected:
  void hear(std::uint64_t writer, std::uint64_t number, std::string_view line) {
    book_.hear({writer, number, "anna@box", line}, now_);
  }
  [[nodiscard]] Replies take() { return book_.take(now_); }

  RequestBook::Clock::time_point now_{seconds(1000)};
  bool let_ = false;
  std::vector<std::string> begun_;
  Lines log_;
  RequestBook book_{[this](std::string_view line) {
                      begun_.emplace_back(line);
                      const bool waits = line == "wait";
                      return BegunRequest{
                          [this, waits, text = std::string(line)] {
                            return waits && !let_ ? std::nullopt : std::optional("done: " + text);
                          },
                          line == "look" ? "" : std::string(line), line != "babble"};
                    },
                    &log_};
};

TEST_F(RequestBookTest, WhatIsAskedIsBegunOnceAnsweredAndLogged) {
  hear(7, 1, "wait");
  hear(7, 1, "wait");
  EXPECT_TRUE(take().empty());
  EXPECT_EQ(book_.open(), 1U);
  let_ = true;
  const Replies replies = take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].target, 7U);
  EXPECT_EQ(replies[0].number, 1U);
  EXPECT_TRUE(replies[0].taken);
  EXPECT_EQ(replies[0].text, "done: wait");
  EXPECT_EQ(book_.open(), 0U);
  EXPECT_EQ(begun_.size(), 1U);
  ASSERT_EQ(log_.lines.size(), 1U);
  EXPECT_EQ(log_.lines[0], "from `anna@box` over the bus: wait");
}

TEST_F(RequestBookTest, AnAnswerThatWasLostIsGivenAgainForAWhile) {
  hear(7, 1, "a");
  ASSERT_EQ(take().size(), 1U);
  hear(7, 1, "a");
  const Replies again = take();
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].text, "done: a");
  EXPECT_EQ(begun_.size(), 1U);
  now_ += RequestBook::kKept + seconds(1);
  static_cast<void>(take());
  hear(7, 1, "a");
  EXPECT_TRUE(take().empty());
  EXPECT_EQ(begun_.size(), 1U);
}

TEST_F(RequestBookTest, ItIsIdleOnlyWhenNoAnswerIsKept) {
  EXPECT_TRUE(book_.idle());
  hear(7, 1, "wait");
  EXPECT_TRUE(take().empty());
  EXPECT_FALSE(book_.idle()) << "it waits for its answer";
  let_ = true;
  ASSERT_EQ(take().size(), 1U);
  EXPECT_FALSE(book_.idle()) << "the answer is kept";
  now_ += RequestBook::kKept + seconds(1);
  EXPECT_TRUE(take().empty());
  EXPECT_TRUE(book_.idle());
}

TEST_F(RequestBookTest, WhatOnlyLooksIsNotLogged) {
  hear(7, 1, "look");
  EXPECT_EQ(take().size(), 1U);
  EXPECT_TRUE(log_.lines.empty());
}

TEST_F(RequestBookTest, NonsenseIsLoggedOnceASecondOfEach) {
  for (std::uint64_t number = 1; number <= 4; ++number) hear(7, number, "babble");
  hear(8, 1, "babble");
  EXPECT_EQ(log_.lines.size(), 2U);
  EXPECT_EQ(take().size(), 5U);
  now_ += seconds(1);
  hear(7, 5, "babble");
  hear(7, 6, "stop");
  hear(7, 7, "stop");
  EXPECT_EQ(log_.lines.size(), 5U);
}

TEST_F(RequestBookTest, WhatIsLoggedCannotSteerATerminalOrFillALine) {
  hear(7, 1, "red\x1b[31m" + std::string(5000, 'x'));
  ASSERT_EQ(log_.lines.size(), 1U);
  EXPECT_EQ(log_.lines[0].find('\x1b'), std::string::npos);
  EXPECT_LT(log_.lines[0].size(), 400U);
}

TEST_F(RequestBookTest, WhoAsksTooOftenIsRefusedOnceASecondAndOthersAreHeard) {
  Replies replies;
  for (std::uint64_t number = 1; number <= 1000; ++number) {
    hear(7, number, "look");
    for (RequestBook::Reply& reply : take()) replies.push_back(std::move(reply));
  }
  const auto refused = std::ranges::count(replies, false, &RequestBook::Reply::taken);
  EXPECT_EQ(refused, 1);
  EXPECT_EQ(replies.size(), static_cast<std::size_t>(RequestBook::kAtOnce) + 1);
  EXPECT_EQ(begun_.size(), static_cast<std::size_t>(RequestBook::kAtOnce));
  EXPECT_EQ(log_.lines.size(), 1U);
  EXPECT_NE(log_.lines[0].find("refused of `anna@box`"), std::string::npos) << log_.lines[0];
  hear(8, 1, "look");
  const Replies other = take();
  ASSERT_EQ(other.size(), 1U);
  EXPECT_TRUE(other[0].taken);
  // What was refused is not done when it comes again; what was not answered is.
  now_ += seconds(1);
  hear(7, static_cast<std::uint64_t>(RequestBook::kAtOnce) + 1, "look");
  EXPECT_EQ(begun_.size(), static_cast<std::size_t>(RequestBook::kAtOnce) + 1) << "that of 8";
  hear(7, 1000, "look");
  EXPECT_EQ(begun_.size(), static_cast<std::size_t>(RequestBook::kAtOnce) + 2);
}

TEST_F(RequestBookTest, TooMuchThatWaitsIsRefused) {
  for (std::uint64_t number = 1; number <= RequestBook::kMostOpenEach + 1; ++number) {
    hear(7, number, "wait");
  }
  EXPECT_EQ(book_.open(), RequestBook::kMostOpenEach);
  const Replies replies = take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].taken);
  EXPECT_EQ(replies[0].number, RequestBook::kMostOpenEach + 1);
  EXPECT_NE(replies[0].text.find("try again later"), std::string::npos);
  for (std::uint64_t writer = 100; writer < 140; ++writer) hear(writer, 1, "wait");
  EXPECT_EQ(book_.open(), RequestBook::kMostOpen);
  let_ = true;
  static_cast<void>(take());
  EXPECT_EQ(book_.open(), 0U);
  hear(7, 100, "look");
  ASSERT_EQ(take().size(), 1U);
}

TEST_F(RequestBookTest, MadeUpAskersAreStoppedTogether) {
  const auto ask = [this](std::uint64_t writer) {
    hear(writer, 1, "look");
    static_cast<void>(take());
  };
  for (std::uint64_t writer = 1; writer <= 10'000; ++writer) ask(writer);
  EXPECT_EQ(begun_.size(), static_cast<std::size_t>(RequestBook::kAllAtOnce));
  now_ += seconds(1);
  for (std::uint64_t writer = 20'001; writer <= 30'000; ++writer) ask(writer);
  EXPECT_EQ(begun_.size(),
            static_cast<std::size_t>(RequestBook::kAllAtOnce + RequestBook::kAllPerSecond));
}

TEST_F(RequestBookTest, ALongAnswerIsFetchedPartByPart) {
  const std::string line(3 * std::size_t{rave_wire_kMaxRequestAnswerBytes}, 'x');
  hear(7, 1, line);
  AnswerParts parts;
  int messages = 0;
  for (Replies replies = take(); !replies.empty() && messages < 10; replies = take()) {
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_TRUE(replies[0].taken);
    EXPECT_LE(replies[0].text.size(), std::size_t{rave_wire_kMaxRequestAnswerBytes});
    ASSERT_TRUE(parts.add(replies[0].text)) << replies[0].text.substr(0, 60);
    ++messages;
    hear(7, 1, request_for_rest(parts.text().size()));
  }
  EXPECT_TRUE(parts.complete());
  EXPECT_EQ(parts.text(), "done: " + line);
  EXPECT_EQ(messages, 4);
  EXPECT_EQ(begun_.size(), 1U);
  now_ += RequestBook::kKept + seconds(1);
  static_cast<void>(take());
  hear(7, 1, request_for_rest(100));
  EXPECT_TRUE(take().empty());
}

TEST_F(RequestBookTest, AnAnswerThatIsTooLongIsNotSent) {
  hear(7, 1, std::string(kMostAnswerBytes, 'x'));
  const Replies replies = take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].taken);
  EXPECT_NE(replies[0].text.find("the bus carries 8388608"), std::string::npos) << replies[0].text;
}

TEST_F(RequestBookTest, LongAnswersAreKeptForAFewAtOnce) {
  const std::string line(kMostAnswerBytes / 2, 'x');
  const std::size_t most = RequestBook::kMostKeptLong / line.size() - 1;
  for (std::uint64_t writer = 1; writer <= most; ++writer) {
    hear(writer, 1, line);
    const Replies replies = take();
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_TRUE(replies[0].taken) << writer;
  }
  hear(99, 1, line);
  const Replies replies = take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].taken);
  EXPECT_NE(replies[0].text.find("try again later"), std::string::npos) << replies[0].text;
  // Who asks anew gives up what was kept for it.
  hear(1, 2, line);
  ASSERT_EQ(take().size(), 1U);
  now_ += RequestBook::kKept + seconds(1);
  static_cast<void>(take());
  hear(99, 2, line);
  const Replies later = take();
  ASSERT_EQ(later.size(), 1U);
  EXPECT_TRUE(later[0].taken);
}

}  // namespace
}  // namespace rave::bus
