// SPDX-License-Identifier: Apache-2.0
// A manager in real time with hosts that are late, go, come back, or are there twice; on a bus that
// the test plays.
#include "../src/live_run.hpp"

#include <gtest/gtest.h>

#include "fake_live_endpoint.hpp"
#include "own_corner.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;

constexpr std::uint64_t kOne = 10;  ///< Processes.
constexpr std::uint64_t kTwo = 11;
constexpr std::uint64_t kThird = 12;
constexpr std::int64_t kLater_ns = 60'000'000'000;

class LiveRunTest : public ::testing::Test {
 protected:
  LiveRunTest() {
    options_.scenario = "pair";
    options_.hosts = {{"one", {0}}, {"two", {1}}};
    options_.robots.push_back({"anna", from_seconds(1)});
    options_.robots.push_back({"bob", from_seconds(1)});
    options_.step = from_seconds(0.01);
    options_.duration = from_seconds(0.4);
    options_.world_period = from_seconds(0.02);
    options_.host_timeout = from_seconds(30);
    options_.log = &lines_;
    options_.stopping = [this] { return stop_ || std::chrono::steady_clock::now() > end_; };
    auto endpoint = std::make_unique<FakeLiveEndpoint>();
    bus_ = endpoint.get();
    hosts_ = std::make_unique<LiveHosts>(options_, std::move(endpoint));
    // Until a test says otherwise both hosts are there all the time.
    bus_->meanwhile = [this] {
      bus_->ping(kOne, 0);
      bus_->ping(kTwo, 1);
    };
  }
  Result<LiveManagerOutcome> try_to_go() {
    sim::EngineSpec spec;
    add_robot(spec, simulated_type());
    add_twin(spec, {3, 0, 0});
    auto edits = LiveEdits::create(std::move(spec), options_, *hosts_).value();
    run_.emplace(options_, std::move(hosts_), std::move(edits));
    return run_->go();
  }
  LiveManagerOutcome go() {
    auto outcome = try_to_go();
    EXPECT_TRUE(outcome) << outcome.error().text();
    return outcome ? *std::move(outcome) : LiveManagerOutcome();
  }
  [[nodiscard]] bool begun() const { return !bus_->worlds.empty(); }
  void gone(std::uint64_t writer) { bus_->endpoint().gone.push_back(writer); }

  LiveManagerOptions options_;
  Lines lines_;
  bool stop_ = false;
  FakeLiveEndpoint* bus_ = nullptr;

 private:
  std::unique_ptr<LiveHosts> hosts_;
  std::optional<LiveRun> run_;
  const std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(60);
};

TEST_F(LiveRunTest, EndsWhenItsTimeIsOverAndTellsEverybody) {
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(outcome.whole) << lines_.said();
  EXPECT_TRUE(outcome.drained);
  EXPECT_GE(outcome.end.ns, options_.duration.ns);
  EXPECT_EQ(outcome.worlds, bus_->worlds.size());
  EXPECT_EQ(bus_->endpoint().phases.back(), rave_wire_RUN_ENDED);
  EXPECT_TRUE(bus_->pongs.back().begun);
}

TEST_F(LiveRunTest, BeginsWithoutALateHostWhichMayStillCome) {
  options_.host_timeout = from_seconds(0.05);
  bus_->meanwhile = [this] {
    bus_->ping(kOne, 0);
    if (begun()) bus_->ping(kTwo, 1);
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(lines_.has("the run begins without two")) << lines_.said();
  EXPECT_TRUE(outcome.hosts[1].heard);
  EXPECT_TRUE(outcome.whole) << "a host that comes later is no problem";
}

TEST_F(LiveRunTest, ALostHostCountsAndItsPlaceIsFree) {
  bool went = false;
  bus_->meanwhile = [this, &went] {
    bus_->ping(kOne, 0);
    bus_->ping(went ? kThird : kTwo, 1);
    if (begun() && !std::exchange(went, true)) gone(kTwo);
  };
  options_.duration = from_seconds(1);
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(lines_.has("host `two` is gone; the others continue")) << lines_.said();
  EXPECT_TRUE(lines_.has("host `two` is back")) << lines_.said();
  ASSERT_EQ(outcome.problems.size(), 1U) << lines_.said();
  EXPECT_EQ(outcome.problems[0], "host `two` was lost once");
  EXPECT_FALSE(outcome.whole);
}

TEST_F(LiveRunTest, GoesOnWithTheTimeThatHostsHave) {
  options_.resume = true;
  options_.duration = Duration{kLater_ns + 200'000'000};
  bus_->meanwhile = [this] {
    bus_->ping(kOne, 0, kLater_ns);
    bus_->ping(kTwo, 1, kLater_ns);
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(lines_.has("takes over at 60.")) << lines_.said();
  ASSERT_FALSE(bus_->worlds.empty());
  EXPECT_GE(bus_->worlds.front(), kLater_ns);
  EXPECT_GE(outcome.end.ns, options_.duration.ns);
}

TEST_F(LiveRunTest, LeavesARunAloneThatItIsNotToResume) {
  bus_->meanwhile = [this] { bus_->ping(kOne, 0, kLater_ns); };
  const auto outcome = try_to_go();
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("hosts are at 60.0 s of a run that lost"),
            std::string::npos)
      << outcome.error().message;
  EXPECT_TRUE(bus_->pongs.empty()) << "nobody is told another time";
}

TEST_F(LiveRunTest, WhoStopsManagingLeavesHostsToTheirRun) {
  bus_->meanwhile = [this] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    stop_ = begun();
  };
  const LiveManagerOutcome outcome = go();
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_EQ(outcome.problems[0].rfind("stopped at ", 0), 0U) << outcome.problems[0];
  EXPECT_FALSE(outcome.whole);
  EXPECT_FALSE(outcome.drained);
  EXPECT_FALSE(bus_->endpoint().over()) << "nobody is told to end";
}

TEST_F(LiveRunTest, WhoOwnsItsHostsEndsThemWhenItIsStopped) {
  options_.ends_hosts = true;
  bus_->meanwhile = [this] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    stop_ = begun();
  };
  EXPECT_TRUE(go().drained);
  EXPECT_EQ(bus_->endpoint().phases.back(), rave_wire_RUN_FAILED);
}

TEST_F(LiveRunTest, AnEndOfTheRunByHandIsAnEnd) {
  runtime::RunControl control;
  options_.control = &control;
  options_.stopping = [&control] { return control.stopping(); };
  bus_->meanwhile = [&] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    if (begun()) control.end_run();
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(outcome.ended_by_hand && outcome.whole);
  EXPECT_TRUE(outcome.problems.empty()) << outcome.problems[0];
  EXPECT_EQ(bus_->endpoint().phases.back(), rave_wire_RUN_ENDED);
}

TEST_F(LiveRunTest, AnEndOfItsManagerAloneIsNotThatOfTheRun) {
  runtime::RunControl control;
  options_.control = &control;
  options_.stopping = [&control] { return control.stopping(); };
  bus_->meanwhile = [&] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    if (begun()) control.stop();
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_FALSE(outcome.ended_by_hand || outcome.whole);
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_FALSE(bus_->endpoint().over()) << "hosts continue";
}

TEST_F(LiveRunTest, WorldsThatCouldNotBeSentAreLeftOut) {
  // The process stands for most of the run.
  bool stood = false;
  bus_->meanwhile = [this, &stood] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    if (!begun() || std::exchange(stood, true)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
  };
  options_.duration = from_seconds(0.5);
  go();
  EXPECT_TRUE(stood);
  // A manager sends from 0.3 s before the run begins; 40 worlds fit into that and the run.
  EXPECT_LT(bus_->worlds.size(), 20U);
}

TEST_F(LiveRunTest, OfTwoProcessesOfAHostTheFirstIsAnswered) {
  bus_->meanwhile = [this] {
    bus_->ping(kOne, 0);
    bus_->ping(kTwo, 1);
    bus_->ping(kThird, 1);
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(outcome.whole) << lines_.said();
  for (const bus::ClockPong& pong : bus_->pongs) EXPECT_NE(pong.target, kThird);
  const auto& faults = bus_->endpoint().faults;
  ASSERT_EQ(faults.size(), 1U) << "told once";
  EXPECT_EQ(faults[0].rfind("refused: ", 0), 0U) << faults[0];
}

TEST_F(LiveRunTest, WhoStoodStillItselfWaitsOnAndSaysSo) {
  options_.host_timeout = from_seconds(0.01);
  FakeEndpoint& common = bus_->endpoint();
  common.stands_still = true;
  common.stood = 2;
  bus_->meanwhile = [this, &common] {
    bus_->ping(kOne, 0);
    if (common.silence_asked > 10) bus_->ping(kTwo, 1);
  };
  const LiveManagerOutcome outcome = go();
  EXPECT_TRUE(lines_.has("all hosts have joined")) << lines_.said();
  EXPECT_FALSE(lines_.has("begins without"));
  EXPECT_FALSE(outcome.whole);
  ASSERT_EQ(outcome.problems.size(), 1U) << lines_.said();
  EXPECT_EQ(outcome.problems[0],
            "the environment manager stood still for so long that hosts may have considered it "
            "lost (2 times): it sent no worlds meanwhile");
}

}  // namespace
}  // namespace rave::manager
