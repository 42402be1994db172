// SPDX-License-Identifier: Apache-2.0
// `kill -9` at random moments of a run in lock-step. RAVE_TEST_SEED and RAVE_KILL_ROUNDS say which
// moments, and how many.
#include <csignal>
#include <iostream>
#include <thread>

#include "kill_rounds.hpp"
#include "onlooker.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;
using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

/// What a killed process may lose of its record is less than a second; a machine that does other
/// things at the same time gets another one.
constexpr std::chrono::seconds kLoss{2};
constexpr double kStep_s = 0.01;

/// While processes look for one another, or in a step of the run.
struct Moment {
  std::uint64_t step = 0;  ///< 0: while they start.
  microseconds after{};
};

class LockStepKill : public KillRound {
 protected:
  void SetUp() override {
    auto opened = StepListener::open(run_, apart());
    ASSERT_TRUE(opened) << opened.error().text();
    steps_ = *std::move(opened);
  }
  Moment moment(std::uint64_t steps, milliseconds start) {
    if (chance_.one_in(5)) return {0, chance_.up_to(start)};
    const std::uint64_t step = 1 + chance_.below(steps);
    return {step, chance_.up_to(milliseconds(2))};
  }
  void wait_for_step(std::uint64_t step) {
    wait_until(
        [&] {
          steps_->listen();
          return steps_->step() >= step;
        },
        "step " + std::to_string(step));
  }
  void wait_for(const Moment& moment) {
    std::cout << "step " << moment.step << " and " << moment.after.count() << " us\n";
    wait_for_step(moment.step);
    std::this_thread::sleep_for(moment.after);
  }
  void wait_for_more_steps() { wait_for_step(steps_->step() + 200); }
  void kill_at(const std::string& name, const Moment& moment) {
    wait_for(moment);
    std::cout << "kill -9 " << name << "\n";
    kill_process(name);
    killed_ = Clock::now();
    steps_->listen();
  }
  /// What must be in the record of a process that was killed just now.
  [[nodiscard]] double least_s() const {
    const std::uint64_t step = steps_->step_at(killed_ - kLoss);
    return step == 0 ? 0 : static_cast<double>(step - 1) * kStep_s;
  }

  std::unique_ptr<StepListener> steps_;
  Clock::time_point killed_{};
};

class AHostIsKilled : public LockStepKill {};

/// The names of policies and what the manager says of a host that is gone.
struct Policy {
  const char* name;
  const char* then;
};
constexpr Policy kPolicies[] = {{"wait", "all hosts wait until it is back"},
                                {"drop", "its robots stop from this step on"},
                                {"restart", "its robots stop until it is back"}};

TEST_P(AHostIsKilled, TheRestGoesOnAsThePolicySays) {
  const Policy& policy = kPolicies[GetParam() % 3];
  const bool drops = policy.name == std::string("drop");
  const bool waits = policy.name == std::string("wait");
  const Words span = of_run({"--duration", "100000"});
  const std::string file = crowd_with_policy(policy.name, 5);
  const std::string victim = chance_.one_in(2) ? "one" : "two";
  const std::string other = victim == "one" ? "two" : "one";
  const Moment when = moment(8000, milliseconds(800));
  std::cout << "policy " << policy.name << "\n";
  start("env", "env", file, span);
  start_host("one", file, span);
  start_host("two", file, span);
  kill_at(victim, when);
  if (when.step > 0) {
    wait_for_line("env", "host `" + victim + "` is gone in step");
    wait_for_line("env", policy.then);
    if (waits) wait_for_line(other, "waiting for " + victim);
    if (!waits) wait_for_more_steps();
  }
  // Before the run has begun, all policies wait for it.
  const bool comes_back = !drops || when.step == 0;
  Words words = span;
  words.insert(words.end(), {"--host", victim});
  if (comes_back) start("again", "robot", file, words);
  if (when.step > 0 && !drops) wait_for_line("env", "host `" + victim + "` is back in step");
  wait_for_more_steps();
  signal("env", SIGINT);
  EXPECT_EQ(end_of("env"), 1) << console("env");
  EXPECT_EQ(end_of(other), 0) << console(other);
  EXPECT_TRUE(result(other)["whole"]) << result(other).dump();
  expect_whole_record(other);
  expect_readable_record(victim, least_s());
  if (comes_back) {
    // A run that had begun just so without it does not let it in, and may be over before it says
    // so.
    signal("again", SIGINT);
    static_cast<void>(end_of("again"));
  }
  if (when.step == 0 || drops) return;
  expect_whole_record("again");
  EXPECT_EQ(result("env")["hash"], nullptr) << "programs have begun anew";
}
INSTANTIATE_TEST_SUITE_P(Round, AHostIsKilled, ::testing::Range(0, kill_rounds()));

class AManagerIsKilled : public LockStepKill {};

TEST_P(AManagerIsKilled, AnotherTakesOverAndTheHashIsThatOfOneProcess) {
  const Words span = {"--duration", "120"};
  static const std::string kAlone = hash_alone("crowd.yaml", span);
  ASSERT_EQ(kAlone.size(), 16U);
  const Words words = of_run(span);
  std::string manager = "env";
  start(manager, "env", "crowd.yaml", words);
  start_host("one", "crowd.yaml", words);
  start_host("two", "crowd.yaml", words);
  // Most of the way is left for the one that takes over, which may be killed as well.
  const std::uint64_t kills = 1 + chance_.below(2);
  for (std::uint64_t kill = 0; kill < kills; ++kill) {
    const Moment when = moment(4000, milliseconds(400));
    kill_at(manager, when);
    // The next one may be there before anybody has missed the one before.
    if (when.step > 0 && chance_.one_in(2)) {
      wait_for_line("one", "the environment manager is lost");
    }
    manager = "manager-" + std::to_string(kill + 2);
    Words goes_on = words;
    goes_on.emplace_back("--resume");
    start(manager, "env", "crowd.yaml", goes_on);
  }
  EXPECT_EQ(end_of(manager), 0) << console(manager);
  EXPECT_EQ(result(manager)["hash"], kAlone);
  for (const char* const host : {"one", "two"}) {
    EXPECT_EQ(end_of(host), 0) << console(host);
    EXPECT_TRUE(result(host)["whole"]) << result(host).dump();
    EXPECT_EQ(result(host)["steps"], 12000);
    expect_whole_record(host);
  }
}
INSTANTIATE_TEST_SUITE_P(Round, AManagerIsKilled, ::testing::Range(0, kill_rounds()));

}  // namespace
}  // namespace rave::cli_test
