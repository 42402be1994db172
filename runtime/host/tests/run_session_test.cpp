// SPDX-License-Identifier: Apache-2.0
// The loop of a run over an exchange that the test plays.
#include "../src/run_session.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "rave/assemble_testing/host_fixture.hpp"

namespace rave::runtime::testing {
namespace {

/// Keeps what the log is told, by all threads.
class Heard final : public LogSink {
 public:
  void write(LogLevel /*level*/, std::string_view source, std::string_view message) override {
    const std::lock_guard lock(mutex_);
    all_ += fmt::format("{}: {}\n", source, message);
    told_.notify_all();
  }
  [[nodiscard]] std::string all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }
  /// Waits until the log was told `text`, but not for ever.
  bool hears(std::string_view text) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, std::chrono::seconds(20),
                          [&] { return all_.find(text) != std::string::npos; });
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable told_;
  std::string all_;
};

/// Gives the turns that the test names, and notes what the loop asks for.
class FakeExchange final : public WorldExchange {
 public:
  explicit FakeExchange(RunSession& run) : run_(run) {}

  Result<bool> begin() override {
    calls += "b";
    return begins;
  }
  Result<bool> await_turn() override {
    calls += "w";
    if (turns == 0) {
      if (!fault) return false;
      return fail(ErrorCode::kIo, "{}", *fault);
    }
    --turns;
    run_.step = run_.engine.steps_done();
    return true;
  }
  Status step() override {
    calls += "s";
    if (meanwhile) meanwhile();
    if (breaks) return fail(ErrorCode::kState, "a driver broke");
    RAVE_TRY(run_.engine.step());
    look_back(run_, beside);
    return {};
  }

  std::string calls{};
  bool begins = true;
  int turns = 3;
  bool breaks = false;                 ///< A step fails.
  std::optional<std::string> fault{};  ///< Of the wait behind the last turn.
  std::function<void()> meanwhile{};
  std::vector<sim::Event> beside{};

 private:
  RunSession& run_;
};

/// Keeps whether it was told that a run begins, and of which scenario.
class Beginner final : public RunObserver {
 public:
  Status run_begins(const RunView& run) override {
    scenario = run.info.scenario;
    ++begun;
    return {};
  }
  void after_step(const StepView& /*step*/) override {}

  int begun = 0;
  std::string scenario{};
};

class RunSessionTest : public ::testing::Test {
 protected:
  RunSessionTest()
      : scenario_(host_
                      .expand(scenario_text("  - {name: anna, pose: {x_m: 0, y_m: 0}, robot: {" +
                                            kBody + ", " + kWheels + "}}\n"))
                      .value()) {
    engine_ = host_.engine_of(config::write_expanded(scenario_));
    options_.picture = false;
    options_.record = false;
    options_.control = &control_;
    options_.on_progress = [this](const report::Progress&) { ++progress_; };
    observers_ = ObserverList::open({.scenario = scenario_,
                                     .expanded = expanded_,
                                     .robot_kinds = host_.kinds(),
                                     .engine = *engine_,
                                     .catalogue = host_.catalogue(),
                                     .options = options_,
                                     .console = console_,
                                     .own = {&beginner_}})
                     .value();
    run_.emplace(*engine_, *observers_, pace_, scenario_.scenario, options_, console_, false);
    exchange_.emplace(*run_);
  }

  Host host_;
  config::ExpandedScenario scenario_;
  std::string expanded_;
  Heard log_;
  ConsoleTee console_{&log_};
  WallPace pace_{0};
  RunControl control_;
  RunOptions options_;
  int progress_ = 0;
  Beginner beginner_;
  std::unique_ptr<sim::Engine> engine_;
  std::unique_ptr<ObserverList> observers_;
  std::optional<RunSession> run_;
  std::optional<FakeExchange> exchange_;
};

TEST_F(RunSessionTest, DoesTheTurnsThatTheExchangeGivesIt) {
  ASSERT_TRUE(go_through(*run_, *exchange_));
  EXPECT_EQ(exchange_->calls, "bwswswsw");
  EXPECT_EQ(engine_->steps_done(), 3U);
  EXPECT_EQ(progress_, 1) << "at once, and then ten times a second";
  EXPECT_EQ(control_.status().scenario, "small") << "others can control it while it exists";
  exchange_.reset();
  run_.reset();
  EXPECT_TRUE(control_.status().scenario.empty());
}

TEST_F(RunSessionTest, TellsItsOwnObserversThatItBegins) {
  ASSERT_FALSE(options_.record);
  ASSERT_TRUE(options_.observers.empty());
  EXPECT_EQ(beginner_.begun, 1);
  EXPECT_EQ(beginner_.scenario, "small");
}

TEST_F(RunSessionTest, WithoutAWorldDoesNoStep) {
  exchange_->begins = false;
  ASSERT_TRUE(go_through(*run_, *exchange_));
  EXPECT_EQ(exchange_->calls, "b");
  EXPECT_EQ(engine_->steps_done(), 0U);
}

TEST_F(RunSessionTest, EndsWithTheFaultOfTheExchange) {
  exchange_->turns = 1;
  exchange_->fault = "the world is gone";
  const Status went = go_through(*run_, *exchange_);
  ASSERT_FALSE(went);
  EXPECT_EQ(went.error().message, "the world is gone");
  EXPECT_EQ(exchange_->calls, "bwsw");
  exchange_->turns = 1;
  exchange_->breaks = true;
  const Status broke = go_through(*run_, *exchange_);
  ASSERT_FALSE(broke);
  EXPECT_EQ(broke.error().message, "a driver broke");
}

TEST_F(RunSessionTest, TellsEventsThatTheEngineDoesNotHave) {
  exchange_->turns = 1;
  exchange_->beside = {{0, RobotId(), sim::EventKind::kObstacleAdded, BodyId(), "crate"}};
  ASSERT_TRUE(go_through(*run_, *exchange_));
  ASSERT_EQ(run_->events.size(), 1U);
  EXPECT_EQ(run_->events[0].text, "crate");
  const RunFacts facts = end_run(*run_);
  ASSERT_EQ(facts.events.size(), 1U) << "they are known at the end";
  EXPECT_TRUE(facts.problems.empty());
}

TEST_F(RunSessionTest, SaysWhenAStepDoesNotEnd) {
  exchange_->turns = 1;
  bool heard = false;
  exchange_->meanwhile = [this, &heard] { heard = log_.hears("step 0 has not ended for 1 s"); };
  ASSERT_TRUE(go_through(*run_, *exchange_));
  EXPECT_TRUE(heard) << log_.all();
}

TEST_F(RunSessionTest, ServesARequestAndRefreshesTheStatus) {
  exchange_->turns = 1;
  std::optional<Result<std::string>> answer;
  std::thread asker([this, &answer] {
    answer = control_.ask({request::Stop(), "anna"}, std::chrono::minutes(1));
  });
  exchange_->meanwhile = [this] {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!control_.status().robots.at(0).stopped && std::chrono::steady_clock::now() < patience) {
      serve_requests(*run_);
    }
  };
  EXPECT_TRUE(go_through(*run_, *exchange_));
  asker.join();
  ASSERT_TRUE(answer && *answer);
  EXPECT_EQ(**answer, "stopped anna");
  EXPECT_TRUE(control_.status().robots.at(0).stopped);
}

}  // namespace
}  // namespace rave::runtime::testing
