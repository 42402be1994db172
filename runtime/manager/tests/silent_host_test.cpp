// SPDX-License-Identifier: Apache-2.0
// A manager in lock-step and its hosts, each on a bus of its own: one of them is there and says
// nothing, which nobody but the clock on the wall notices.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "own_corner.hpp"
#include "rave/manager/manager.hpp"
#include "rave/protocol/host_port.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;

constexpr std::uint64_t kSteps = 30;
constexpr std::uint64_t kSilentFrom = 7;
/// Long enough that nobody who answers is taken for silent on a busy machine.
constexpr double kTimeout_s = 2;

/// Two robots that drive ahead.
sim::EngineSpec two_robots() {
  sim::EngineSpec spec;
  sim::RobotType type = simulated_type();
  type.program = program<sim::testing::Drive>({{"v", 0.5}});
  add_robot(spec, std::move(type));
  add_twin(spec, {0, 3, 0});
  return spec;
}

lock_step::Identity identity_of(std::uint32_t host, const std::string& name) {
  return {host, name, host == rave_wire_kNone ? 0U : 1U, 7, 9};
}

/// A host of one robot, in a thread of its own.
class QuietHost {
 public:
  /// Says nothing from this step on, though it stays, until speak() or its end.
  QuietHost(bus::BusConfig config, std::uint32_t number, const char* name,
            std::optional<std::uint64_t> silent_from = {})
      : silent_from_(silent_from) {
    config.participant = name;
    config.beside = true;
    thread_ = std::thread(
        [this, config, identity = identity_of(number, name)] { serve(config, identity); });
  }
  QuietHost(const QuietHost&) = delete;
  QuietHost& operator=(const QuietHost&) = delete;
  ~QuietHost() { leave(); }
  /// It goes and speaks no more. It is gone then: who takes its place finds that free.
  void leave() {
    ends_ = true;
    speak();
    if (thread_.joinable()) thread_.join();
  }
  /// From this step on it says that it is in one that cannot be.
  void lie_from(std::uint64_t step) { lies_from_ = step; }
  void speak() {
    speaks_ = true;
    speaks_.notify_all();
  }

 private:
  void serve(const bus::BusConfig& config, const lock_step::Identity& identity) {
    sim::EngineSpec spec = two_robots();
    spec.local = {RobotId(identity.host)};
    const auto engine = make_engine(std::move(spec));
    auto port = lock_step::HostPort::open(config, identity, nullptr);
    ASSERT_TRUE(port) << port.error().text();
    sim::HostReport report;
    report.host = identity.host;
    sim::WorldStep world;
    for (;;) {
      ASSERT_TRUE(engine->propose(report));
      if (silent_from_ && report.step >= *silent_from_) speaks_.wait(false);
      if (ends_) return;
      report.step += report.step >= lies_from_ ? 1000U : 0U;
      const auto answer =
          (*port)->exchange(report, engine->hash().value(), world, [this] { return ends_.load(); });
      ASSERT_TRUE(answer) << answer.error().text();
      if (*answer != lock_step::HostPort::Answer::kWorld || world.last) return;
      ASSERT_TRUE(engine->join(world, (*port)->authority()));
    }
  }

  const std::optional<std::uint64_t> silent_from_;
  std::atomic<bool> speaks_ = false;
  std::atomic<bool> ends_ = false;
  std::atomic<std::uint64_t> lies_from_ = ~std::uint64_t{0};
  std::thread thread_;
};

class SilentHost : public ::testing::Test {
 protected:
  SilentHost() {
    options_.bus = own_corner();
    options_.identity = identity_of(rave_wire_kNone, "environment manager");
    options_.scenario = "two";
    options_.hosts = {{"one", {0}}, {"two", {1}}};
    options_.steps = kSteps;
    options_.host_timeout = from_seconds(kTimeout_s);
    options_.log = &lines_;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    // If nobody notices anything.
    options_.stopping = [end] { return std::chrono::steady_clock::now() > end; };
  }
  ManagerOutcome run() {
    auto outcome = manage(two_robots(), options_);
    EXPECT_TRUE(outcome) << outcome.error().text();
    return outcome ? *std::move(outcome) : ManagerOutcome();
  }

  ManagerOptions options_;
  Lines lines_;
};

TEST_F(SilentHost, IsGivenUpAndTheRunIsNotCalledWhole) {
  for (const auto policy : {config::LostHost::kDrop, config::LostHost::kRestart}) {
    options_.bus = own_corner();
    options_.on_lost_host = policy;
    const QuietHost one(options_.bus, 0, "one");
    const QuietHost two(options_.bus, 1, "two", kSilentFrom);
    const ManagerOutcome outcome = run();
    EXPECT_EQ(outcome.steps, kSteps);
    EXPECT_FALSE(outcome.whole);
    EXPECT_FALSE(outcome.hash) << "it would be of another run";
    ASSERT_EQ(outcome.problems.size(), 1U) << lines_.said();
    const char* const then = policy == config::LostHost::kDrop ? "its robots stop from this step on"
                                                               : "its robots stop until it is back";
    EXPECT_EQ(outcome.problems[0],
              fmt::format("host `two` has not answered for {:.1f} s in step {}; {}", kTimeout_s,
                          kSilentFrom, then));
  }
}

TEST_F(SilentHost, IsWaitedForAndNamedUntilItSpeaks) {
  options_.on_lost_host = config::LostHost::kWait;
  const QuietHost one(options_.bus, 0, "one");
  QuietHost two(options_.bus, 1, "two", kSilentFrom);
  std::string told;
  options_.on_progress = [&](const ManagerOptions::Progress& progress) {
    if (!lines_.has("all hosts wait for it")) return;
    if (told.empty()) told = progress.waiting;
    two.speak();
  };
  const ManagerOutcome outcome = run();
  EXPECT_TRUE(outcome.whole) << lines_.said();
  EXPECT_TRUE(outcome.problems.empty());
  EXPECT_TRUE(lines_.has(
      fmt::format("host `two` has not answered for {:.1f} s in step {}", kTimeout_s, kSilentFrom)))
      << lines_.said();
  EXPECT_TRUE(lines_.has(fmt::format("host `two` answers again, in step {}", kSilentFrom)))
      << lines_.said();
  EXPECT_EQ(told, "two");
  const auto alone = make_engine(two_robots());
  sim::testing::run(*alone, static_cast<int>(kSteps));
  ASSERT_TRUE(outcome.hash);
  EXPECT_EQ(*outcome.hash, alone->hash().value()) << "the run is what it would have been";
}

TEST_F(SilentHost, ThatIsReplacedInTheMiddleMakesItAnotherRun) {
  options_.on_lost_host = config::LostHost::kWait;
  const QuietHost one(options_.bus, 0, "one");
  QuietHost two(options_.bus, 1, "two", kSilentFrom);
  std::optional<QuietHost> other;
  options_.on_progress = [&](const ManagerOptions::Progress& progress) {
    if (other || progress.step != kSilentFrom) return;
    two.leave();
    other.emplace(options_.bus, 1, "two");
  };
  const ManagerOutcome outcome = run();
  EXPECT_EQ(outcome.steps, kSteps);
  EXPECT_FALSE(outcome.whole) << "its program began anew";
  EXPECT_FALSE(outcome.hash);
  EXPECT_EQ(outcome.problems.size(), 1U) << lines_.said();
}

TEST_F(SilentHost, ThatSpeaksOfAStepThatCannotBeEndsARunThatWouldWaitForIt) {
  options_.on_lost_host = config::LostHost::kWait;
  const QuietHost one(options_.bus, 0, "one");
  QuietHost two(options_.bus, 1, "two");
  two.lie_from(kSilentFrom);
  const auto outcome = manage(two_robots(), options_);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kState);
  EXPECT_NE(outcome.error().message.find("invalid report of host `two`: it is of step 1007"),
            std::string::npos)
      << outcome.error().message;
}

TEST_F(SilentHost, ThatIsInTheMiddleOfAnotherRunIsLeftAlone) {
  const QuietHost one(options_.bus, 0, "one");
  QuietHost two(options_.bus, 1, "two");
  two.lie_from(0);
  const auto outcome = manage(two_robots(), options_);
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kState);
  EXPECT_NE(outcome.error().message.find("host `two` is in step 1000 of a run that lost its "
                                         "environment manager: --resume"),
            std::string::npos)
      << outcome.error().message;
}

}  // namespace
}  // namespace rave::manager
