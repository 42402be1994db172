// SPDX-License-Identifier: Apache-2.0
// Which commands of a sender are carried out, once, and what it is told.
#include "rave/bus/command_book.hpp"

#include <gtest/gtest.h>

#include <map>

#include "rave/bus/sequence.hpp"

namespace rave::bus {
namespace {

/// A process that notes what it was asked, and answers when it is told to.
class CommandBookTest : public ::testing::Test {
 protected:
  void hear(std::uint64_t number, rave_wire_CommandKind kind = rave_wire_COMMAND_GOAL,
            std::uint64_t writer = 1, std::uint32_t robot = 0) {
    Command command{};
    command.writer = writer;
    command.robot = robot;
    command.kind = kind;
    command.number = number;
    put_text(command.author, "lisa");
    book_.hear(command, now_);
  }
  using Clock = CommandBook::Clock;

  std::vector<std::uint64_t> begun_;
  std::map<std::uint64_t, CommandResult> results_;  ///< By number; absent: not available yet.
  Clock::time_point now_ = Clock::time_point{} + std::chrono::hours(1);
  CommandBook book_{[this](const Command& command) -> BegunCommand {
                      begun_.push_back(command.number);
                      if (command.kind == rave_wire_COMMAND_DRIVE) return {};
                      const std::uint64_t number = command.number;
                      return [this, number]() -> std::optional<CommandResult> {
                        const auto found = results_.find(number);
                        if (found == results_.end()) return std::nullopt;
                        return found->second;
                      };
                    },
                    nullptr};
};

TEST_F(CommandBookTest, AnOrderIsAnsweredWhenItsResultIsThere) {
  hear(1);
  EXPECT_TRUE(book_.take().empty());
  EXPECT_FALSE(book_.idle());
  results_[1] = {true, "r1 is sent to 1.00, 2.00"};
  const auto replies = book_.take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].target, 1U);
  EXPECT_EQ(replies[0].number, 1U);
  EXPECT_TRUE(replies[0].result.accepted);
  EXPECT_EQ(replies[0].result.text, "r1 is sent to 1.00, 2.00");
  EXPECT_TRUE(book_.idle());
}

TEST_F(CommandBookTest, ARepetitionIsNotCarriedOutAgainButAnsweredAgain) {
  hear(1);
  hear(1);
  EXPECT_EQ(begun_.size(), 1U);
  results_[1] = {false, "`anna` drives r1"};
  EXPECT_EQ(book_.take().size(), 1U);
  hear(1);
  EXPECT_EQ(begun_.size(), 1U);
  const auto replies = book_.take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_FALSE(replies[0].result.accepted);
  EXPECT_EQ(replies[0].result.text, "`anna` drives r1");
}

TEST_F(CommandBookTest, AnOldOrderDoesNotUndoANewerOneAndItsSenderIsTold) {
  hear(5);
  hear(4);
  EXPECT_EQ(begun_, std::vector<std::uint64_t>{5});
  const auto replies = book_.take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].number, 4U);
  EXPECT_FALSE(replies[0].result.accepted);
  EXPECT_EQ(replies[0].result.text, "the command arrived after a newer one for the same robot");
}

TEST_F(CommandBookTest, DrivesGetNoAnswerAndOldOnesAreIgnored) {
  hear(2, rave_wire_COMMAND_DRIVE);
  hear(1, rave_wire_COMMAND_DRIVE);
  hear(2, rave_wire_COMMAND_DRIVE);
  EXPECT_EQ(begun_, std::vector<std::uint64_t>{2});
  EXPECT_TRUE(book_.take().empty());
  EXPECT_TRUE(book_.idle());
}

TEST_F(CommandBookTest, SendersAndRobotsCountForThemselves) {
  hear(5);
  hear(4, rave_wire_COMMAND_GOAL, 2);
  hear(3, rave_wire_COMMAND_GOAL, 1, 1);
  EXPECT_EQ(begun_, (std::vector<std::uint64_t>{5, 4, 3}));
}

TEST_F(CommandBookTest, AThousandOrdersAtOnceAreAllAnswered) {
  for (std::uint32_t robot = 0; robot < 1000; ++robot) {
    hear(robot + 1, rave_wire_COMMAND_GOAL, 1, robot);
    results_[robot + 1] = {true, "done"};
  }
  EXPECT_EQ(begun_.size(), 1000U);
  EXPECT_EQ(book_.take().size(), 1000U);
}

TEST_F(CommandBookTest, BeyondTheRateCommandsWaitForTheirRepetition) {
  constexpr std::uint64_t kAtOnce = 5000;
  for (std::uint64_t i = 1; i <= kAtOnce + 3; ++i) hear(i, rave_wire_COMMAND_DRIVE);
  EXPECT_EQ(begun_.size(), kAtOnce);
  now_ += std::chrono::seconds(1);
  hear(kAtOnce + 3, rave_wire_COMMAND_GOAL);
  EXPECT_EQ(begun_.size(), kAtOnce + 1) << "it was not taken for a repetition";
}

TEST_F(CommandBookTest, AStopHasNoLimit) {
  for (std::uint64_t i = 1; i <= 6000; ++i) hear(i, rave_wire_COMMAND_TEXT);
  const std::size_t begun = begun_.size();
  ASSERT_EQ(begun, 5000U);
  hear(6001, rave_wire_COMMAND_STOP, 1, 7);
  EXPECT_EQ(begun_.size(), begun + 1);
}

TEST_F(CommandBookTest, OrdersThatWaitForTheirResultsHaveALimit) {
  for (std::uint64_t i = 1; i <= CommandBook::kMostOpen + 1; ++i) {
    if (i % 4000 == 0) now_ += std::chrono::seconds(1);
    hear(i, rave_wire_COMMAND_TEXT);
  }
  EXPECT_EQ(begun_.size(), CommandBook::kMostOpen);
  const auto replies = book_.take();
  ASSERT_EQ(replies.size(), 1U);
  EXPECT_EQ(replies[0].result.text, "too many orders are waiting; try again later");
}

}  // namespace
}  // namespace rave::bus
