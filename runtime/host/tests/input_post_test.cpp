// SPDX-License-Identifier: Apache-2.0
// What people ask of a host in lock-step, with an authority that the test plays: what is forwarded,
// when it counts, and who is told what.
#include "../src/input_post.hpp"

#include <gtest/gtest.h>

#include <future>

#include "rave/sim/world_authority.hpp"
#include "rave/sim_testing/order_programs.hpp"

namespace rave::runtime {
namespace {

using namespace sim::testing;
using namespace std::chrono_literals;

constexpr std::uint64_t kFirst = 5000;

/// r0 and r1 run here, r2 on another host, which does nothing.
sim::EngineSpec three() {
  sim::EngineSpec spec;
  spec.world.obstacles.push_back(box({4, 0, 0}, 0.2, 4, 1, "wall"));
  add_robot(spec, driver_type(), {0, 0, 0});
  add_robot(spec, listener_type(), {0, 2, 0});
  add_robot(spec, driver_type(), {0, -2, 0});
  return spec;
}

request::Request request_of(request::Action action, const std::string& robot = {}) {
  return {std::move(action), robot, "anna"};
}

class InputPostTest : public ::testing::Test {
 protected:
  InputPostTest() {
    authority_ = *sim::WorldAuthority::create(three(), {0, 0, 1});
    for (std::uint32_t h = 0; h < 2; ++h) {
      sim::EngineSpec spec = three();
      spec.local = h == 0 ? std::vector{RobotId(0), RobotId(1)} : std::vector{RobotId(2)};
      engines_.push_back(make_engine(std::move(spec)));
      reports_[h].host = h;
      EXPECT_TRUE(engines_[h]->propose(reports_[h]));
    }
    post_.emplace(*engines_[0], 0, kFirst, nullptr);
  }
  /// Asks as somebody who waits for the answer. What is refused at once is the error.
  Result<std::string> ask(const request::Request& request) {
    RAVE_TRY_ASSIGN(std::string text, post_->give(request));
    const auto given = post_->take_given();
    if (!given) return text;
    std::promise<Result<std::string>> promise;
    answers_.push_back(promise.get_future());
    post_->await(*given, RunControl::Asked(request, std::move(promise), asked_at_), text);
    return text;
  }
  /// The world of the next step, for the reports as they are now.
  void make_world() {
    post_->put(reports_[0]);
    const sim::HostReport* const reports[] = {&reports_[0], &reports_[1]};
    ASSERT_TRUE(authority_->step(reports, world_));
  }
  /// It is done by both hosts.
  void do_step() {
    post_->take(world_);
    for (std::size_t h = 0; h < 2; ++h) {
      ASSERT_TRUE(engines_[h]->apply(world_));
      ASSERT_TRUE(engines_[h]->propose(reports_[h]));
    }
    told_ = post_->settle(reports_[0].refusals);
  }
  void step() {
    make_world();
    do_step();
  }
  /// What somebody was told; empty: nothing yet.
  std::string answer(std::size_t index) {
    if (answers_.at(index).wait_for(0s) != std::future_status::ready) return {};
    const auto text = answers_[index].get();
    return text ? *text : "refused: " + text.error().message;
  }
  static std::string why(const Result<std::string>& text) {
    return text ? "accepted" : text.error().message;
  }

  std::unique_ptr<sim::WorldAuthority> authority_;
  std::vector<std::unique_ptr<sim::Engine>> engines_;
  sim::HostReport reports_[2];
  sim::WorldStep world_;
  std::optional<InputPost> post_;
  std::vector<std::future<Result<std::string>>> answers_;
  const InputPost::Clock::time_point asked_at_ = InputPost::Clock::time_point(1h);
  bool told_ = false;
};

TEST_F(InputPostTest, AnOrderCountsFromTheNextWorldAndIsAnsweredWhenItsStepIsDone) {
  step();
  const auto drive = request_of(request::Drive{0.5, 0}, "r0");
  EXPECT_EQ(why(ask(drive)), "accepted");
  EXPECT_TRUE(post_->is_driven("r0")) << "though the run does not know it yet";
  EXPECT_EQ(engines_[0]->order_of(RobotId(0)), "");
  make_world();
  ASSERT_EQ(world_.inputs.size(), 1U);
  EXPECT_EQ(world_.inputs[0].author.name, "anna");
  EXPECT_EQ(answer(0), "");
  do_step();
  EXPECT_TRUE(told_);
  EXPECT_EQ(answer(0), "r0 is driven; counts from step 1 on, at 0.010 s");
  EXPECT_EQ(engines_[0]->order_of(RobotId(0)), "drive");
  step();
  EXPECT_TRUE(world_.inputs.empty()) << "it is asked once";
  EXPECT_FALSE(told_);
}

TEST_F(InputPostTest, WhatAWorldDoesNotAnswerIsInTheNextReport) {
  make_world();
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted");
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r0"))), "accepted");
  do_step();
  EXPECT_EQ(answer(0), "") << "the world was made without it";
  step();
  EXPECT_EQ(answer(0), "r1 is sent to 1.00, 2.00; counts from step 1 on, at 0.010 s");
  EXPECT_EQ(answer(1), "stopped r0; counts from step 1 on, at 0.010 s");
  EXPECT_TRUE(engines_[0]->stopped(RobotId(0)));
}

TEST_F(InputPostTest, WhatThisHostKnowsIsRefusedAtOnce) {
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 0}, {}}, "r0"))),
            "robot `r0`, goal: neither its program nor one of its controllers takes goals");
  EXPECT_NE(
      why(ask(request_of(request::Goal{{4, 0}, {}}, "r1"))).find("is inside the obstacle `wall`"),
      std::string::npos);
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 0}, {}}, "r2"))),
            "robot `r2` runs in another process of this run");
  EXPECT_NE(why(ask(request_of(request::Stop(), "r9"))).find("r9"), std::string::npos);
  request::Request nobody = request_of(request::Stop(), "r0");
  nobody.by = "two\nlines";
  EXPECT_NE(why(ask(nobody)).find("control characters"), std::string::npos);
  EXPECT_EQ(why(ask(request_of(request::Release()))), "accepted");
  make_world();
  EXPECT_TRUE(world_.answers.empty()) << "there was nothing to release";
  EXPECT_TRUE(answers_.empty());
}

TEST_F(InputPostTest, WhatTheAuthorityKnowsIsRefusedWithItsWorld) {
  EXPECT_EQ(why(ask(request_of(request::Place{{4, 0}, {}}, "r0"))), "accepted");
  EXPECT_EQ(why(ask(request_of(request::Place{{1, 1}, {}}, "r0"))), "accepted");
  step();
  const std::string refused = answer(0);
  EXPECT_TRUE(refused.starts_with("refused: ")) << refused;
  EXPECT_NE(refused.find("it would overlap `wall`"), std::string::npos) << refused;
  EXPECT_EQ(answer(1), "r0 is placed at 1.00, 1.00; counts from step 0 on, at 0.000 s");
}

TEST_F(InputPostTest, WhatChangesBeforeTheStepIsRefusedByTheStep) {
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r1"))), "accepted");
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted")
      << "it is not stopped yet";
  EXPECT_NE(why(ask(request_of(request::Goal{{1e9, 2}, {}}, "r1"))).find("is outside the world"),
            std::string::npos)
      << "that does not depend on it";
  EXPECT_EQ(why(ask(request_of(request::Arm(), "r1"))),
            "stopped: r1; a stop holds until it is released (`--release`)");
  step();
  EXPECT_EQ(answer(0), "stopped r1; counts from step 0 on, at 0.000 s");
  EXPECT_EQ(answer(1),
            "refused: robot `r1`, goal: it is stopped; a stop holds until it is released");
  EXPECT_EQ(why(ask(request_of(request::Release()))), "accepted");
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted")
      << "by then it is free";
  step();
  EXPECT_EQ(answer(2), "released r1; counts from step 1 on, at 0.010 s");
  EXPECT_EQ(answer(3), "r1 is sent to 1.00, 2.00; counts from step 1 on, at 0.010 s");
}

TEST_F(InputPostTest, AStopOfAllIsOfThoseThatRunHere) {
  EXPECT_EQ(ask(request_of(request::Stop())).value(), "stopped r0 and r1");
  make_world();
  ASSERT_EQ(world_.inputs.size(), 2U);
  do_step();
  EXPECT_TRUE(engines_[0]->stopped(RobotId(0)) && engines_[0]->stopped(RobotId(1)));
  EXPECT_FALSE(engines_[1]->stopped(RobotId(2)));
  EXPECT_EQ(answer(0), "stopped r0 and r1; counts from step 0 on, at 0.000 s") << "once, for both";
  EXPECT_EQ(ask(request_of(request::Stop())).value(), "stopped r0 and r1");
  make_world();
  EXPECT_TRUE(world_.inputs.empty()) << "they are";
}

TEST_F(InputPostTest, WhileTheRunStandsWhoWaitsIsToldWhatWillBe) {
  const auto path = request_of(request::Path{{{1, 2}, {2, 2}}, 0}, "r1");
  EXPECT_EQ(why(ask(path)), "accepted");
  EXPECT_FALSE(post_->put_off("paused", 7, asked_at_ + 900ms));
  EXPECT_TRUE(post_->put_off("paused", 7, asked_at_ + 1s));
  EXPECT_EQ(answer(0),
            "requested; the run does not advance now: paused, so the request is carried out or "
            "refused in step 7; the log of this process has the result");
  EXPECT_FALSE(post_->put_off("paused", 7, asked_at_ + 2s)) << "once";
  step();
  EXPECT_EQ(engines_[0]->order_of(RobotId(1)), "path of 2 points to 2.00, 2.00") << "and it is";
}

TEST_F(InputPostTest, AfterAGapNothingOldIsDone) {
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted");
  post_->drop("the run continued without the host of the robot");
  EXPECT_EQ(answer(0), "refused: the run continued without the host of the robot");
  make_world();
  EXPECT_TRUE(world_.inputs.empty());
}

TEST_F(InputPostTest, AnswersToAnEarlierProcessOfTheHostAreNotTaken) {
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted");
  make_world();
  world_.answers[0].asked = kFirst;
  post_->take(world_);
  EXPECT_EQ(reports_[0].inputs.size(), 1U);
  reports_[0].inputs.clear();
  post_->put(reports_[0]);
  EXPECT_EQ(reports_[0].inputs.size(), 1U) << "it is asked for on";
}

TEST_F(InputPostTest, AnswersToAnotherHostAreNotTaken) {
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted");
  make_world();
  ASSERT_EQ(world_.answers.size(), 1U);
  world_.answers[0].host = 1;
  post_->take(world_);
  post_->settle({});
  EXPECT_EQ(answer(0), "") << "the number is that of a request to the other one";
}

TEST_F(InputPostTest, OfSeveralRobotsOneRefusalIsTheAnswer) {
  EXPECT_EQ(ask(request_of(request::Stop())).value(), "stopped r0 and r1");
  make_world();
  ASSERT_EQ(world_.answers.size(), 2U);
  post_->take(world_);
  post_->settle({{world_.answers[0].sequence, "it cannot be stopped"}});
  EXPECT_EQ(answer(0), "refused: it cannot be stopped");
}

TEST_F(InputPostTest, AReportHasWhatWaitsOnce) {
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r0"))), "accepted");
  post_->put(reports_[0]);
  post_->put(reports_[0]);
  EXPECT_EQ(reports_[0].inputs.size(), 1U) << "it is put each time that the host is asked";
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r1"))), "accepted");
  post_->put(reports_[0]);
  EXPECT_EQ(reports_[0].inputs.size(), 2U);
}

TEST_F(InputPostTest, ATextToADrivenRobotLeavesItDriven) {
  const auto drive = request_of(request::Drive{0.2, 0}, "r1");
  EXPECT_EQ(why(ask(drive)), "accepted");
  const auto text = request_of(request::Text{"hello"}, "r1");
  EXPECT_EQ(why(ask(text)), "accepted");
  EXPECT_TRUE(post_->is_driven("r1"));
  EXPECT_FALSE(post_->is_driven("r0"));
  EXPECT_EQ(why(ask(request_of(request::Cancel(), "r1"))), "accepted");
  EXPECT_FALSE(post_->is_driven("r1"));
}

TEST_F(InputPostTest, AReleaseOfAnotherRobotPromisesNothing) {
  EXPECT_EQ(why(ask(request_of(request::Stop()))), "accepted");
  step();
  EXPECT_EQ(why(ask(request_of(request::Release(), "r0"))), "accepted");
  EXPECT_NE(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))).find("it is stopped"),
            std::string::npos)
      << "the next step can only refuse it";
}

TEST_F(InputPostTest, WhatAnOldReportAskedForIsNotSaidToBeDoneAfterAGap) {
  EXPECT_EQ(why(ask(request_of(request::Goal{{1, 2}, {}}, "r1"))), "accepted");
  make_world();
  post_->drop("the run continued without the host of the robot");
  EXPECT_EQ(answer(0), "refused: the run continued without the host of the robot");
  EXPECT_TRUE(post_->settle({})) << "the refusal was an answer";
  post_->take(world_);
  EXPECT_FALSE(post_->settle({})) << "the step gives no second answer";
}

TEST_F(InputPostTest, MoreThanAReportHasRoomForAreRefusedButAStopNever) {
  const request::Request goal = request_of(request::Goal{{1, 2}, {}}, "r1");
  std::size_t taken = 0;
  std::string refused;
  while (refused.empty() && taken < 2 * InputPost::kMostWaiting) {
    const auto text = post_->give(goal);
    if (text) ++taken;
    if (!text) refused = text.error().message;
  }
  EXPECT_EQ(taken, InputPost::kMostWaiting);
  EXPECT_EQ(refused, "too many requests wait for the next step; try again later");
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r1"))), "accepted");
}

TEST_F(InputPostTest, TooMuchForOneStepIsRefusedButAStopNever) {
  request::Path line;
  for (int i = 0; i < 1000; ++i) line.points_W.push_back({0.001 * i, 2});
  const auto path = request_of(line, "r1");
  std::string refused;
  int taken = 0;
  while (refused.empty() && taken < 1000) {
    const auto text = post_->give(path);
    if (text) ++taken;
    if (!text) refused = text.error().message;
  }
  EXPECT_EQ(taken, 100);
  EXPECT_EQ(refused, "too many requests wait for the next step; try again later");
  EXPECT_EQ(why(ask(request_of(request::Stop(), "r1"))), "accepted");
}

TEST_F(InputPostTest, AThousandOrdersInOneStepAreAllAnswered) {
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(why(ask(request_of(request::Goal{{0.001 * i, 2}, {}}, "r1"))), "accepted") << i;
  }
  step();
  EXPECT_EQ(world_.inputs.size(), 1000U);
  for (std::size_t i = 0; i < 1000; ++i) {
    EXPECT_NE(answer(i).find("counts from step 0 on"), std::string::npos) << i;
  }
}

}  // namespace
}  // namespace rave::runtime
