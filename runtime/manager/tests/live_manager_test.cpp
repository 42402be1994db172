// SPDX-License-Identifier: Apache-2.0
// A manager in real time from its beginning to its end: what it says of hosts that are not as they
// should be.
#include "rave/manager/live_manager.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "own_corner.hpp"
#include "rave/sim_testing/engine_fixture.hpp"
#include "speaking_host.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;

/// Robot `anna` runs on host `one`, `bob` on `two`.
class LiveManagerTest : public ::testing::Test {
 public:
  LiveManagerTest() {
    options_.bus = own_corner();
    options_.identity = {rave_wire_kNone, "environment manager", 0, 7, 9, true};
    options_.scenario = "pair";
    options_.hosts = {{"one", {0}}, {"two", {1}}};
    options_.robots.push_back({"anna", from_seconds(0.2)});
    options_.robots.push_back({"bob", from_seconds(0.2)});
    options_.step = from_seconds(0.01);
    options_.duration = from_seconds(2);
    options_.world_period = from_seconds(0.05);
    options_.host_timeout = from_seconds(30);
    options_.log = &lines_;
    options_.on_end = [this](const world::WorldModel&) { over_ = true; };
    options_.stopping = [this] { return std::chrono::steady_clock::now() > end_; };
  }
  ~LiveManagerTest() override {
    if (thread_.joinable()) thread_.join();
  }

 protected:
  void start() {
    thread_ = std::thread([this] {
      sim::EngineSpec spec;
      add_robot(spec, simulated_type());
      add_twin(spec, {3, 0, 0});
      outcome_.emplace(manage_live(std::move(spec), options_));
      over_ = true;
    });
  }
  /// Hosts ping until it is so or the run is over.
  void go_until(std::initializer_list<SpeakingHost*> hosts, const std::function<bool()>& so,
                std::int64_t run_ns = -1) {
    while (!over_ && !so() && std::chrono::steady_clock::now() < end_) {
      for (SpeakingHost* const host : hosts) {
        if (const std::uint64_t manager = host->find_manager(); manager != 0) {
          host->ping(manager, run_ns);
        }
      }
      lines_.wait(std::chrono::milliseconds(20));
    }
  }
  void finish() { thread_.join(); }
  [[nodiscard]] bool says(const std::string& problem) const {
    const auto& all = (*outcome_)->problems;
    return std::ranges::find(all, problem) != all.end();
  }

  LiveManagerOptions options_;
  Lines lines_;
  std::optional<Result<LiveManagerOutcome>> outcome_;
  std::atomic<bool> over_ = false;

 private:
  const std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(60);
  std::thread thread_;
};

TEST_F(LiveManagerTest, LeavesHostsAloneThatAreInTheMiddleOfARun) {
  start();
  {
    SpeakingHost one(options_.bus, 0, "one");
    go_until(
        {&one}, [] { return false; }, 60'000'000'000);
  }
  finish();
  ASSERT_FALSE(*outcome_);
  EXPECT_EQ(outcome_->error().code, ErrorCode::kState);
  EXPECT_NE(outcome_->error().message.find("hosts are at 60.0 s of a run that lost its "
                                           "environment manager: --resume continues that run"),
            std::string::npos)
      << outcome_->error().message;
}

TEST_F(LiveManagerTest, BeginsWithoutAHostThatNeverComesAndSaysSo) {
  options_.host_timeout = from_seconds(0.3);
  options_.duration = from_seconds(0.5);
  start();
  {
    SpeakingHost one(options_.bus, 0, "one");
    go_until({&one}, [] { return false; });
  }
  finish();
  ASSERT_TRUE(*outcome_) << outcome_->error().text();
  EXPECT_FALSE((*outcome_)->whole);
  EXPECT_TRUE(says("host `two` never joined")) << lines_.said();
  EXPECT_TRUE((*outcome_)->hosts[0].heard);
}

TEST_F(LiveManagerTest, NamesRobotsThatAreNotHeardOfAndHostsThatWereLost) {
  options_.duration = from_seconds(4);
  start();
  {
    SpeakingHost one(options_.bus, 0, "one");
    std::optional<SpeakingHost> two(std::in_place, options_.bus, 1, "two");
    go_until({&one, &*two}, [this] { return lines_.has("all hosts have joined"); });
    EXPECT_FALSE(lines_.has("is stale"));
    one.say(0, {0}, 0);
    go_until({&one, &*two}, [this] { return lines_.has("robot `anna` is stale"); });
    EXPECT_TRUE(lines_.has("robot `anna` is stale")) << lines_.said();
    // As of a moment that is not there yet: it is surely not too old.
    one.say(0, {0}, 30);
    go_until({&one, &*two}, [this] { return lines_.has("robot `anna` is back"); });
    EXPECT_TRUE(lines_.has("robot `anna` is back")) << lines_.said();
    two.reset();
    go_until({&one}, [this] { return lines_.has("host `two` is gone"); });
    go_until({&one}, [] { return false; });
  }
  finish();
  ASSERT_TRUE(*outcome_) << outcome_->error().text();
  EXPECT_FALSE((*outcome_)->whole);
  EXPECT_TRUE(says("host `two` was lost once")) << lines_.said();
  EXPECT_FALSE(says("host `one` was lost once")) << "who goes at the end is not lost";
}

}  // namespace
}  // namespace rave::manager
