// SPDX-License-Identifier: Apache-2.0
// A manager in lock-step with hosts that are late, go, come back, or say what they should not; on a
// bus that the test plays, so that all happens in the step in which it should.
#include "../src/stepped_run.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>

#include "fake_stepped_endpoint.hpp"
#include "own_corner.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;

constexpr std::uint64_t kAll = 30;    ///< Steps of the run.
constexpr std::uint64_t kMoment = 7;  ///< When something happens.

sim::EngineSpec driving_pair() {
  sim::EngineSpec spec;
  sim::RobotType type = simulated_type();
  type.program = program<sim::testing::Drive>({{"v", 0.5}});
  add_robot(spec, std::move(type));
  add_twin(spec, {0, 3, 0});
  return spec;
}

std::unique_ptr<sim::WorldAuthority> authority_of_pair() {
  return sim::WorldAuthority::create(driving_pair(), {0, 1}).value();
}

class SteppedRunTest : public ::testing::Test {
 protected:
  SteppedRunTest() {
    options_.scenario = "pair";
    options_.hosts = {{"one", {0}}, {"two", {1}}};
    options_.steps = kAll;
    options_.host_timeout = from_seconds(0.05);
    options_.log = &lines_;
    options_.stopping = [this] { return stop_ || std::chrono::steady_clock::now() > end_; };
    for (std::uint32_t h = 0; h < 2; ++h) hosts_.emplace_back(driving_pair(), h);
    auto endpoint = std::make_unique<FakeSteppedEndpoint>(hosts_);
    bus_ = endpoint.get();
    run_.emplace(options_, authority_of_pair(), std::move(endpoint));
  }
  ManagerOutcome go() {
    auto outcome = run_->go();
    EXPECT_TRUE(outcome) << outcome.error().text();
    return outcome ? *std::move(outcome) : ManagerOutcome();
  }
  void expect_that_of_one_process(const ManagerOutcome& outcome) {
    EXPECT_TRUE(outcome.whole) << lines_.said();
    EXPECT_EQ(outcome.steps, kAll);
    const auto alone = make_engine(driving_pair());
    sim::testing::run(*alone, static_cast<int>(kAll));
    ASSERT_TRUE(outcome.hash);
    EXPECT_EQ(*outcome.hash, alone->hash().value());
  }
  /// Both hosts come to step kMoment of a run that then loses its manager.
  void begin_with_another_manager() {
    const auto authority = authority_of_pair();
    sim::WorldStep world;
    for (std::uint64_t step = 0; step < kMoment; ++step) {
      const sim::HostReport* const reports[] = {&hosts_[0].report(), &hosts_[1].report()};
      ASSERT_TRUE(authority->step(reports, world));
      for (EngineHost& host : hosts_) host.take(world, authority->state(true));
    }
    bus_->handed.emplace(world, authority->state(true));
    for (EngineHost& host : hosts_) host.lose_manager();
  }

  ManagerOptions options_;
  Lines lines_;
  bool stop_ = false;
  std::vector<EngineHost> hosts_;
  FakeSteppedEndpoint* bus_ = nullptr;
  std::optional<SteppedRun> run_;

 private:
  const std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(60);
};

TEST_F(SteppedRunTest, EndsWithItsLastStepAndTellsEverybody) {
  expect_that_of_one_process(go());
  EXPECT_TRUE(hosts_[0].done && hosts_[1].done);
  EXPECT_EQ(bus_->common.phases.back(), rave_wire_RUN_ENDED);
  EXPECT_TRUE(bus_->refused.empty());
}

TEST_F(SteppedRunTest, ALateHostIsWaitedForAndNamed) {
  hosts_[1].says = [this](std::uint64_t step) {
    return step != kMoment || lines_.has("all hosts wait for it");
  };
  expect_that_of_one_process(go());
  EXPECT_TRUE(lines_.has("host `two` answers again, in step 7")) << lines_.said();
  EXPECT_TRUE(bus_->common.saw(1, rave_wire_HOST_LATE));
  EXPECT_FALSE(bus_->common.saw(0, rave_wire_HOST_LATE));
}

TEST_F(SteppedRunTest, WithoutALostHostItIsAnotherRun) {
  options_.on_lost_host = config::LostHost::kDrop;
  hosts_[1].says = [](std::uint64_t step) { return step < kMoment; };
  bus_->meanwhile = [this] { bus_->leave(hosts_[1]); };
  const ManagerOutcome outcome = go();
  EXPECT_EQ(outcome.steps, kAll) << "the other goes on";
  EXPECT_FALSE(outcome.whole);
  EXPECT_FALSE(outcome.hash);
  ASSERT_EQ(outcome.problems.size(), 1U) << lines_.said();
  EXPECT_EQ(outcome.problems[0], "host `two` is gone in step 7; its robots stop from this step on");
}

TEST_F(SteppedRunTest, WhoWasCutOffIsHeardAgainOnceItHasIntroducedItself) {
  bool cut = false;
  int spoken = 0;
  hosts_[1].says = [&](std::uint64_t step) {
    if (step != kMoment) return true;
    if (!std::exchange(cut, true)) bus_->common.gone.push_back(hosts_[1].writer);
    if (!lines_.has("host `two` is gone")) return false;
    // It goes on speaking; the manager has not heard yet who that is.
    if (++spoken > 3) bus_->common.hosts[hosts_[1].writer] = 1;
    return true;
  };
  bool back_unknown = false;
  bus_->meanwhile = [&] {
    const bool known = bus_->common.hosts.contains(hosts_[1].writer);
    back_unknown = back_unknown || (!known && lines_.has("host `two` is back"));
  };
  expect_that_of_one_process(go());
  EXPECT_TRUE(lines_.has("host `two` is gone in step 7; all hosts wait until it is back"))
      << lines_.said();
  EXPECT_TRUE(lines_.has("host `two` is back in step 7")) << lines_.said();
  EXPECT_FALSE(back_unknown);
}

TEST_F(SteppedRunTest, GoesOnWhereAnotherManagerEnded) {
  begin_with_another_manager();
  options_.resume = true;
  expect_that_of_one_process(go());
  EXPECT_TRUE(lines_.has("takes over from a lost manager at step 7")) << lines_.said();
}

TEST_F(SteppedRunTest, LeavesARunAloneThatItIsNotToResume) {
  begin_with_another_manager();
  const auto outcome = run_->go();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("is in step 7 of a run that lost"), std::string::npos)
      << outcome.error().message;
  run_->give_up(outcome.error());
  EXPECT_FALSE(bus_->common.over()) << "nobody is told to end";
}

TEST_F(SteppedRunTest, SomebodyStopsItAndHostsGetALastWorld) {
  options_.on_world = [this](const sim::WorldAuthority& authority) {
    stop_ = authority.steps_done() >= kMoment;
    return false;
  };
  const ManagerOutcome outcome = go();
  EXPECT_FALSE(outcome.whole);
  EXPECT_LT(outcome.steps, kMoment + 3);
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_EQ(outcome.problems[0].rfind("stopped in step ", 0), 0U) << outcome.problems[0];
  EXPECT_TRUE(hosts_[0].done && hosts_[1].done);
  EXPECT_EQ(bus_->common.phases.back(), rave_wire_RUN_FAILED);
}

TEST_F(SteppedRunTest, AnEndByHandIsAnEnd) {
  runtime::RunControl control;
  options_.control = &control;
  options_.stopping = [&control] { return control.stopping(); };
  options_.on_world = [&control](const sim::WorldAuthority& authority) {
    if (authority.steps_done() >= kMoment) control.stop();
    return false;
  };
  auto endpoint = std::make_unique<FakeSteppedEndpoint>(hosts_);
  bus_ = endpoint.get();
  run_.emplace(options_, authority_of_pair(), std::move(endpoint));
  const ManagerOutcome outcome = go();
  EXPECT_TRUE(outcome.whole && outcome.ended_by_hand);
  EXPECT_LT(outcome.steps, kMoment + 3);
  EXPECT_TRUE(outcome.problems.empty()) << outcome.problems[0];
  EXPECT_TRUE(outcome.hash) << "of the steps that were made";
  EXPECT_TRUE(hosts_[0].done && hosts_[1].done);
  EXPECT_EQ(bus_->common.phases.back(), rave_wire_RUN_ENDED);
}

TEST_F(SteppedRunTest, SomebodyStopsItBeforeAHostHasCome) {
  hosts_[1].says = [](std::uint64_t) { return false; };
  bus_->meanwhile = [this] { stop_ = true; };
  const ManagerOutcome outcome = go();
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_EQ(outcome.problems[0], "stopped while waiting for two");
  EXPECT_FALSE(outcome.hash);
}

TEST_F(SteppedRunTest, ACheckEndsItAndThatIsWhole) {
  options_.on_world = [](const sim::WorldAuthority& authority) {
    return authority.steps_done() >= kMoment;
  };
  const ManagerOutcome outcome = go();
  EXPECT_TRUE(outcome.whole) << lines_.said();
  EXPECT_EQ(outcome.steps, kMoment + 1) << "the step of that world is done";
  EXPECT_TRUE(hosts_[0].done && hosts_[1].done);
}

TEST_F(SteppedRunTest, AWorldThatWasLostIsSentAgain) {
  bool lost = false;
  bus_->loses = [this, &lost](const EngineHost& host, std::uint64_t step) {
    return &host == &hosts_[1] && step == kMoment && !std::exchange(lost, true);
  };
  expect_that_of_one_process(go());
  EXPECT_TRUE(lost);
  EXPECT_GT(bus_->resent, 0);
}

TEST_F(SteppedRunTest, OfTwoAnswersOfAHostTheFirstCounts) {
  hosts_[1].twice = true;
  expect_that_of_one_process(go());
}

TEST_F(SteppedRunTest, WhoStoodStillItselfGivesNobodyUp) {
  options_.on_lost_host = config::LostHost::kDrop;
  bus_->common.stands_still = true;
  hosts_[1].says = [this](std::uint64_t step) {
    return step != kMoment || bus_->common.silence_asked > 3;
  };
  expect_that_of_one_process(go());
  EXPECT_FALSE(lines_.has("has not answered")) << lines_.said();
}

/// What a person asks of robot 1: a stop.
std::vector<sim::WorldInput> stop_of_one(std::uint64_t number) {
  sim::WorldInput stop;
  stop.sequence = number;
  stop.author.name = "anna";
  stop.robot = RobotId(1);
  return {stop};
}

class ForwardedInputs : public SteppedRunTest {
 protected:
  /// The run is that of one process in which robot 1 was stopped before that step.
  void expect_stopped_at(const ManagerOutcome& outcome, std::uint64_t step) {
    const auto alone = make_engine(driving_pair());
    sim::testing::run(*alone, static_cast<int>(step));
    alone->stop(RobotId(1), {true, "anna"});
    sim::testing::run(*alone, static_cast<int>(kAll - step));
    ASSERT_TRUE(outcome.hash);
    EXPECT_EQ(*outcome.hash, alone->hash().value()) << lines_.said();
    ASSERT_EQ(bus_->answers.size(), 1U) << "it is done once";
    EXPECT_EQ(bus_->answers[0].first, step);
    EXPECT_EQ(bus_->answers[0].second.host, 1U);
    EXPECT_EQ(bus_->answers[0].second.asked, 77U);
    EXPECT_EQ(bus_->answers[0].second.sequence, 1U);
  }
};

TEST_F(ForwardedInputs, CountFromTheStepOfTheReport) {
  hosts_[1].forwards = [](std::uint64_t step) {
    return step == kMoment ? stop_of_one(77) : std::vector<sim::WorldInput>();
  };
  expect_stopped_at(go(), kMoment);
}

TEST_F(ForwardedInputs, CountAlsoIfTheyComeWhileAnotherHostIsWaitedFor) {
  hosts_[0].says = [this](std::uint64_t step) { return step != kMoment || hosts_[1].spoken > 3; };
  hosts_[1].forwards = [this](std::uint64_t step) {
    const bool asked = step == kMoment && hosts_[1].spoken > 1;
    return asked ? stop_of_one(77) : std::vector<sim::WorldInput>();
  };
  expect_stopped_at(go(), kMoment);
}

TEST_F(ForwardedInputs, AreTakenFromAHostWithoutItsManagerByTheNext) {
  begin_with_another_manager();
  options_.resume = true;
  hosts_[1].forwards = [](std::uint64_t step) {
    return step == kMoment ? stop_of_one(77) : std::vector<sim::WorldInput>();
  };
  expect_stopped_at(go(), kMoment);
}

TEST_F(ForwardedInputs, OfARobotOfAnotherHostAreRefusedAndItIsWaitedForTheRightReport) {
  hosts_[0].forwards = [this](std::uint64_t step) {
    const bool wrong = step == kMoment && hosts_[0].spoken < 3;
    return wrong ? stop_of_one(77) : std::vector<sim::WorldInput>();
  };
  expect_that_of_one_process(go());
  ASSERT_FALSE(bus_->refused.empty());
  EXPECT_NE(bus_->refused[0].find("an input that its host may not forward"), std::string::npos)
      << bus_->refused[0];
  EXPECT_TRUE(bus_->answers.empty());
}

TEST_F(SteppedRunTest, OrdersAreForTheHostOfTheRobotAndStopsAreForAll) {
  runtime::RunControl control;
  options_.control = &control;
  std::vector<std::future<Result<std::string>>> answers;
  const auto ask = [&](request::Action action, const std::string& robot, const std::string& by) {
    auto answer = control.post({std::move(action), robot, by});
    ASSERT_TRUE(answer);
    answers.push_back(*std::move(answer));
  };
  options_.on_world = [&](const sim::WorldAuthority& authority) {
    if (authority.next_step() != kMoment + 1) return false;
    ask(request::Drive(), "r1", "anna");
    ask(request::Take(), "r0", "anna");
    ask(request::Cancel(), "", "");
    ask(request::Release(), "r1", "anna");
    ask(request::Stop(), "r1", "bert");
    ask(request::Release(), "r1", "");
    return false;
  };
  run_.emplace(options_, authority_of_pair(), [&] {
    auto endpoint = std::make_unique<FakeSteppedEndpoint>(hosts_);
    bus_ = endpoint.get();
    return endpoint;
  }());
  EXPECT_TRUE(go().whole) << lines_.said();
  const auto text = [](std::future<Result<std::string>>& answer) {
    const auto said = answer.get();
    return said ? *said : "refused: " + said.error().message;
  };
  ASSERT_EQ(answers.size(), 6U);
  EXPECT_EQ(text(answers[0]),
            "refused: `drive` is for host `two` of robot `r1`, which keeps its lease");
  EXPECT_EQ(text(answers[1]),
            "refused: `take` is for host `one` of robot `r0`, which keeps its lease");
  EXPECT_EQ(text(answers[2]),
            "refused: `cancel` is for the hosts of the robots, which keep their leases");
  EXPECT_EQ(text(answers[3]),
            "refused: `release` is for host `two` of robot `r1`, which keeps its lease");
  EXPECT_EQ(text(answers[4]), "stopped r1; counts from step 8 on, at 0.080 s");
  EXPECT_EQ(text(answers[5]), "released r1; counts from step 8 on, at 0.080 s");
}

}  // namespace
}  // namespace rave::manager
