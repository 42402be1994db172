// SPDX-License-Identifier: Apache-2.0
#include "page/page_commands.hpp"

#include <gtest/gtest.h>

#include "fake_run.hpp"

namespace rave::gui_server {
namespace {

class PageCommandsTest : public ::testing::Test {
 protected:
  static CommandMessage drive(std::vector<std::uint32_t> slots, double v) {
    CommandMessage command;
    command.action = request::Drive{v, 0};
    command.slots = std::move(slots);
    return command;
  }
  std::shared_ptr<testing::FakeRun> run_ = std::make_shared<testing::FakeRun>();
  std::vector<PageAnswer> said_;
  int told_ = 0;
};

TEST_F(PageCommandsTest, OneMessageHasOneAnswerThatNamesWhoRefused) {
  PageCommands commands([this](const PageAnswer& answer) { said_.push_back(answer); },
                        [this](const CommandMessage&, const PageAnswer&) { ++told_; });
  commands.begin(run_, {"ada", false});
  CommandMessage goal;
  goal.action = request::Goal();
  goal.request = 9;
  goal.slots = {0, 2};
  commands.take(goal);
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_FALSE(said_[0].good);
  EXPECT_EQ(said_[0].request, 9U);
  EXPECT_EQ(said_[0].text, "`spy-2` drives walker-3");
  ASSERT_EQ(said_[0].refused.size(), 1U);
  EXPECT_EQ(said_[0].refused[0].first, 2U);
  EXPECT_EQ(run_->commands()[0].second.name, "ada");
  EXPECT_EQ(told_, 1);
}

TEST_F(PageCommandsTest, WhoGoesLeavesNoRobotDriving) {
  {
    PageCommands commands([](const PageAnswer&) {}, [](const auto&, const auto&) {});
    commands.begin(run_, {"ada", false});
    commands.take(drive({0, 1}, 0.3));
    commands.take(drive({1}, 0));
    commands.let_go();
    commands.let_go();
  }
  const auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 4U);
  EXPECT_TRUE(asked[2].first.stands());
  EXPECT_EQ(asked[2].first.slots, (std::vector<std::uint32_t>{0}));
}

/// The run of the test tells of no lease, as one does that has just been asked.
TEST_F(PageCommandsTest, WhoGoesLeavesTheLeasesOfWhatItHasOrdered) {
  PageCommands commands([](const PageAnswer&) {}, [](const auto&, const auto&) {});
  commands.begin(run_, {"ada", false, 7});
  CommandMessage goal;
  goal.action = request::Goal();
  // The last is refused, though the page may have its lease from before; there is no fifth.
  goal.slots = {3, 2, 4};
  commands.take(goal);
  CommandMessage set;
  set.action = request::Set();
  set.slots = {0};
  commands.take(set);
  CommandMessage take;
  take.action = request::Take();
  take.slots = {1};
  commands.take(take);
  CommandMessage give;
  give.action = request::Give{"ben"};
  give.slots = {3};
  commands.take(give);
  commands.let_go();
  commands.let_go();
  auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 5U);
  EXPECT_EQ(asked[4].first.action, request::Action(request::Give{"ada"}));
  EXPECT_EQ(asked[4].first.slots, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(asked[4].second, (Author{"ada", false, 7}));
  // For the run it is another page when it has shown its key.
  commands.take(take);
  commands.set_author({"ada", true, 7});
  EXPECT_EQ(run_->commands().size(), 6U);
  commands.set_author({"ada", true, 8});
  asked = run_->commands();
  ASSERT_EQ(asked.size(), 7U);
  EXPECT_EQ(asked[6].first.action, request::Action(request::Give{"ada"}));
  EXPECT_EQ(asked[6].second.page, 7U);
}

TEST_F(PageCommandsTest, TooMuchIsRefusedButToStandNeverIs) {
  PageCommands commands([this](const PageAnswer& answer) { said_.push_back(answer); },
                        [](const auto&, const auto&) {});
  commands.begin(run_, {"ada", false});
  for (int i = 0; i < 10'000 && (said_.empty() || said_.back().good); ++i) {
    commands.take(drive({0}, 0.3));
  }
  EXPECT_FALSE(said_.back().good);
  EXPECT_NE(said_.back().text.find("Too many orders"), std::string::npos);
  commands.take(drive({0}, 0));
  EXPECT_TRUE(said_.back().good);
}

TEST_F(PageCommandsTest, ARunThatAnswersLateGetsTheNewestVelocityAlone) {
  struct Slow final : testing::FakeRun {
    void command(const CommandMessage& command, const Author& /*author*/,
                 const SlotReply& reply) override {
      asked.push_back(command);
      replies.push_back(reply);
    }
    std::vector<CommandMessage> asked;
    std::vector<SlotReply> replies;
  };
  auto slow = std::make_shared<Slow>();
  PageCommands commands([](const PageAnswer&) {}, [](const auto&, const auto&) {});
  commands.begin(slow, {"ada", false});
  for (int i = 1; i <= 50; ++i) commands.take(drive({0}, 0.01 * i));
  EXPECT_EQ(slow->asked.size(), std::size_t{PageCommands::kMostWaiting});
  slow->replies[0](0, true, "");
  ASSERT_EQ(slow->asked.size(), std::size_t{PageCommands::kMostWaiting} + 1);
  EXPECT_EQ(slow->asked.back().action, request::Action(request::Drive{0.01 * 50, 0}));
  // A stop does not wait, and nothing comes after it.
  commands.take(drive({0}, 0.2));
  commands.take(drive({0}, 0));
  EXPECT_TRUE(slow->asked.back().stands());
  const std::size_t asked = slow->asked.size();
  for (std::size_t i = 1; i < asked; ++i) slow->replies[i](0, true, "");
  EXPECT_EQ(slow->asked.size(), asked);
}

}  // namespace
}  // namespace rave::gui_server
