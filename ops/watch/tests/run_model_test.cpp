// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/run_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::watch {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kManager = 1;

bus::HostInfo info_of(std::uint64_t writer, std::uint32_t host, const char* name, bool real_time) {
  bus::HostInfo info{};
  info.writer = writer;
  info.host = host;
  bus::put_text(info.name, name);
  bus::put_text(info.machine, "lab-1");
  info.clock = real_time ? rave_wire_CLOCK_REAL_TIME : rave_wire_CLOCK_LOCK_STEP;
  info.robots = 3;
  return info;
}

bus::ProcessState process_of(std::uint64_t writer, std::uint64_t number, std::uint64_t step) {
  bus::ProcessState state{};
  state.writer = writer;
  state.number = number;
  state.step = step;
  state.process = 4711;
  state.robots = 3;
  state.real_robots = 1;
  state.cpu_ns = static_cast<std::int64_t>(number) * kSecond / 2;
  state.memory_bytes = 64'000'000;
  state.round_trip_ns = 200'000;
  state.deadlines = 200;
  state.missed_deadlines = 150;
  state.worst_late_ns = 3 * kSecond;
  state.behind_ns = 2 * kSecond;
  bus::put_text(state.late_phase, "sense");
  return state;
}

/// A run with a manager and the hosts `left` and `right`, of which the first alone is there.
class RunModelTest : public ::testing::Test {
 protected:
  explicit RunModelTest(bool real_time = false) {
    model_.hear(info_of(kManager, rave_wire_kNone, "environment manager", real_time));
    model_.hear(info_of(2, 0, "left", real_time));
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      sights_[i].host = static_cast<std::uint32_t>(i);
      bus::put_text(sights_[i].name, i == 0 ? "left" : "right");
      sights_[i].robots = 3;
      sights_[i].bound_s = -1;
    }
    sights_[0].phase = rave_wire_HOST_RUNS;
    tell(0, 0);
  }
  void tell(std::uint64_t step, std::int64_t now_ns,
            rave_wire_RunPhase phase = rave_wire_RUN_RUNNING) {
    bus::RunState state{};
    state.writer = kManager;
    bus::put_text(state.scenario, "flock");
    state.phase = phase;
    state.step = step;
    state.steps = 6000;
    state.step_s = 0.01;
    bus::borrow(state.hosts, sights_);
    model_.hear(state, now_ns);
  }
  [[nodiscard]] HostView host(std::size_t number, std::int64_t now_ns) const {
    return model_.view(now_ns, false).hosts.at(number + 1);
  }
  [[nodiscard]] Standing standing(std::size_t number, std::int64_t now_ns) const {
    return host(number, now_ns).standing;
  }

  RunModel model_{"00ff"};
  std::vector<rave_wire_HostSight> sights_ = std::vector<rave_wire_HostSight>(2);
};

TEST_F(RunModelTest, TheManagerComesFirstThenTheHostsByNumber) {
  const RunView view = model_.view(0, false);
  ASSERT_EQ(view.hosts.size(), 3U);
  EXPECT_TRUE(view.hosts[0].manager);
  EXPECT_EQ(view.hosts[1].name, "left");
  EXPECT_EQ(view.hosts[2].name, "right");
  EXPECT_EQ(view.scenario, "flock");
  EXPECT_EQ(view.timing, Timing::kLockStep);
  EXPECT_EQ(view.phase, Phase::kRunning);
  EXPECT_DOUBLE_EQ(*view.duration_s, 60);
  EXPECT_EQ(view.hosts[1].standing, Standing::kHere);
  EXPECT_EQ(view.hosts[2].standing, Standing::kWaiting);
}

TEST_F(RunModelTest, WhoIsGoneIsGoneAtOnceAndBackUnderAnotherNumber) {
  model_.lose(2);
  EXPECT_EQ(standing(0, kSecond), Standing::kGone) << "before the manager says so";
  model_.hear(info_of(9, 0, "left", false));
  EXPECT_EQ(standing(0, kSecond), Standing::kHere);
  sights_[0].phase = rave_wire_HOST_LOST;
  tell(5, kSecond);
  EXPECT_EQ(standing(0, kSecond), Standing::kWaiting) << "it is not back in the run yet";
  sights_[0].phase = rave_wire_HOST_DROPPED;
  tell(5, kSecond);
  EXPECT_EQ(standing(0, kSecond), Standing::kDropped);
}

TEST_F(RunModelTest, WhoWasLostBeforeTheOnlookerCameIsGoneToo) {
  sights_[1].phase = rave_wire_HOST_LOST;
  tell(5, kSecond);
  EXPECT_EQ(standing(1, kSecond), Standing::kGone);
}

TEST_F(RunModelTest, WhoIsSilentIsLate) {
  model_.hear(process_of(2, 1, 100), 0, 0);
  EXPECT_EQ(standing(0, 2 * kSecond), Standing::kHere);
  EXPECT_EQ(standing(0, 3 * kSecond), Standing::kLate);
  model_.hear(process_of(2, 2, 100), 4 * kSecond, 0);
  EXPECT_EQ(standing(0, 4 * kSecond), Standing::kHere);
  sights_[0].phase = rave_wire_HOST_LATE;
  tell(5, 4 * kSecond);
  EXPECT_EQ(standing(0, 4 * kSecond), Standing::kLate) << "the manager waits for it";
}

TEST_F(RunModelTest, WhatAProcessSaysOfItself) {
  model_.hear(process_of(2, 1, 100), 0, 0);
  model_.hear(process_of(2, 3, 1100), 2 * kSecond, 350'000);
  const HostView left = host(0, 2 * kSecond);
  EXPECT_EQ(left.process, 4711U);
  EXPECT_EQ(left.robots, 3U);
  EXPECT_EQ(left.real_robots, 1U);
  EXPECT_EQ(left.step, 1100U);
  EXPECT_DOUBLE_EQ(left.rate_hz.value(), 500);
  EXPECT_FALSE(left.asked_rate_hz);
  EXPECT_DOUBLE_EQ(left.cores.value(), 0.5);
  EXPECT_DOUBLE_EQ(left.memory_mb.value(), 64);
  EXPECT_DOUBLE_EQ(left.delay_s.value(), 350e-6);
  EXPECT_DOUBLE_EQ(left.round_trip_s.value(), 200e-6);
  EXPECT_DOUBLE_EQ(left.missed_pct.value(), 75);
  EXPECT_DOUBLE_EQ(left.worst_late_s.value(), 3);
  EXPECT_DOUBLE_EQ(left.behind_s.value(), 2);
  EXPECT_EQ(left.late_phase, "sense");
  EXPECT_EQ(left.lost, 1U) << "its second message never came";
  EXPECT_FALSE(host(0, 4 * kSecond).age_s) << "the next message may be on its way";
  EXPECT_DOUBLE_EQ(host(0, 5 * kSecond).age_s.value(), 3) << "since it was in a new step";
}

TEST_F(RunModelTest, TwoMessagesInARowSayNothingOfCores) {
  const auto hear = [this](std::uint64_t number, double cpu_s, double now_s) {
    auto state = process_of(2, number, number);
    state.cpu_ns = from_seconds(cpu_s).ns;
    model_.hear(state, from_seconds(now_s).ns, 0);
  };
  hear(1, 10, 1);
  EXPECT_FALSE(host(0, kSecond).cores);
  // The next one came 10 ms after it, and was sent half a second after it.
  hear(2, 10.25, 1.01);
  EXPECT_FALSE(host(0, 2 * kSecond).cores);
  hear(3, 10.5, 2);
  EXPECT_DOUBLE_EQ(host(0, 2 * kSecond).cores.value(), 0.5);
  hear(4, 10.75, 2.1);
  EXPECT_DOUBLE_EQ(host(0, 3 * kSecond).cores.value(), 0.5);
  hear(5, 11.5, 3);
  EXPECT_DOUBLE_EQ(host(0, 3 * kSecond).cores.value(), 1);
}

TEST(RunModelAlone, WhoHearsNothingIsToldWhy) {
  const RunModel model("00ff");
  EXPECT_FALSE(model.knows_any());
  EXPECT_EQ(model.view(0, true).text, "no process of the run was found");
}

TEST_F(RunModelTest, TheSpeedIsThatOfLately) {
  tell(100, 10 * kSecond);
  EXPECT_DOUBLE_EQ(model_.view(10 * kSecond, false).speed.value(), 0) << "as the manager says";
  tell(200, 11 * kSecond);
  const RunView view = model_.view(11 * kSecond, false);
  EXPECT_DOUBLE_EQ(view.speed.value(), 1);
  EXPECT_DOUBLE_EQ(view.hosts[0].rate_hz.value(), 100);
  EXPECT_EQ(view.step, 200U);
}

TEST_F(RunModelTest, WithoutAManagerARunInLockStepStands) {
  model_.lose(kManager);
  const RunView view = model_.view(kSecond, false);
  EXPECT_EQ(view.hosts[0].standing, Standing::kGone);
  EXPECT_EQ(view.phase, Phase::kWaits);
  EXPECT_EQ(view.text, "the environment manager is lost");
  EXPECT_EQ(view.hosts[1].standing, Standing::kHere) << "what the dead said of it does not count";
}

TEST_F(RunModelTest, ARunThatIsOverStaysSo) {
  tell(6000, kSecond, rave_wire_RUN_ENDED);
  model_.lose(kManager);
  EXPECT_EQ(model_.view(2 * kSecond, false).phase, Phase::kEnded);
}

TEST_F(RunModelTest, TheNextManagerIsListenedTo) {
  model_.lose(kManager);
  model_.hear(info_of(7, rave_wire_kNone, "environment manager", false));
  bus::RunState state{};
  state.writer = 7;
  state.phase = rave_wire_RUN_GATHERING;
  model_.hear(state, kSecond);
  tell(50, kSecond);  // from the dead one; it came late
  const RunView view = model_.view(kSecond, false);
  EXPECT_EQ(view.phase, Phase::kGathering);
  EXPECT_EQ(view.hosts[0].standing, Standing::kHere);
}

TEST_F(RunModelTest, JsonHasNothingForWhatIsNotKnown) {
  model_.hear(process_of(2, 1, 100), 0, 0);
  const auto json = nlohmann::json::parse(to_json(model_.view(0, true)));
  EXPECT_EQ(json["rave_top"], 1);
  EXPECT_EQ(json["timing"], "lock_step");
  EXPECT_EQ(json["hosts"][0]["role"], "manager");
  EXPECT_EQ(json["hosts"][1]["state"], "here");
  EXPECT_EQ(json["hosts"][1]["real_robots"], 1);
  EXPECT_EQ(json["hosts"][1]["rate_hz"], nullptr);
  EXPECT_EQ(json["hosts"][2]["machine"], nullptr);
  EXPECT_EQ(json["robots"], nlohmann::json::array());
}

bus::RosterEntry entry_of(std::uint64_t writer, std::uint32_t robot, std::uint32_t host,
                          const char* name, rave_wire_RobotKind kind = rave_wire_ROBOT_SIMULATED) {
  bus::RosterEntry entry{};
  entry.writer = writer;
  entry.robot = robot;
  entry.host = host;
  bus::put_text(entry.name, name);
  bus::put_text(entry.team, "blue");
  entry.kind = kind;
  return entry;
}

TEST_F(RunModelTest, RobotsHaveTheNamesThatTheirHostsSay) {
  model_.hear(entry_of(2, 1, 0, "bob", rave_wire_ROBOT_REAL));
  model_.hear(entry_of(2, 0, 0, "anna"));
  // Before its process has introduced itself.
  model_.hear(entry_of(3, 2, 1, "carl"));
  const auto robots = model_.view(0, true).robots;
  ASSERT_EQ(robots.size(), 3U) << "in lock-step nobody says where they are";
  EXPECT_EQ(robots[0].name, "anna");
  EXPECT_EQ(robots[0].host, "left");
  EXPECT_EQ(robots[0].team, "blue");
  EXPECT_EQ(robots[0].simulated, true);
  EXPECT_EQ(robots[1].name, "bob");
  EXPECT_EQ(robots[1].simulated, false);
  EXPECT_EQ(robots[2].host, "right");
  const auto json = nlohmann::json::parse(to_json(model_.view(0, true)));
  EXPECT_EQ(json["robots"][1]["name"], "bob");
  EXPECT_EQ(json["robots"][1]["team"], "blue");
  EXPECT_EQ(json["robots"][1]["simulated"], false);
  EXPECT_EQ(json["robots"][1]["age_s"], nullptr);
}

TEST_F(RunModelTest, WhoDrivesIsSeen) {
  bus::RosterEntry entry = entry_of(2, 0, 0, "anna");
  bus::put_text(entry.driver, "lisa");
  model_.hear(entry);
  EXPECT_EQ(model_.view(0, true).robots.at(0).driver, "lisa");
  EXPECT_EQ(nlohmann::json::parse(to_json(model_.view(0, true)))["robots"][0]["driver"], "lisa");
  model_.hear(entry_of(2, 0, 0, "anna"));
  EXPECT_EQ(nlohmann::json::parse(to_json(model_.view(0, true)))["robots"][0]["driver"], nullptr);
}

TEST_F(RunModelTest, AHandOverIsSeen) {
  model_.hear(process_of(2, 1, 100), 0, 0);
  for (const std::uint32_t robot : {0U, 1U, 2U}) model_.hear(entry_of(2, robot, 0, "anna"));
  EXPECT_EQ(host(0, 0).real_robots, 0U) << "the process said 1 when it started";
  model_.hear(entry_of(2, 1, 0, "anna", rave_wire_ROBOT_REAL));
  EXPECT_EQ(host(0, 0).real_robots, 1U);
  EXPECT_EQ(model_.view(0, true).robots[1].simulated, false);
}

TEST_F(RunModelTest, WhatASecondProcessSaysCountsWhenTheFirstIsGone) {
  model_.hear(entry_of(2, 0, 0, "anna"));
  model_.hear(process_of(2, 1, 100), kSecond, 0);
  model_.hear(info_of(9, 0, "left", false));
  model_.hear(entry_of(9, 0, 0, "eve"));
  EXPECT_EQ(model_.view(kSecond, true).robots.at(0).name, "anna");
  model_.lose(2);
  EXPECT_EQ(model_.view(kSecond, true).robots.at(0).name, "eve");
}

class LiveRunModelTest : public RunModelTest {
 protected:
  LiveRunModelTest() : RunModelTest(true) {}

  void report(std::uint64_t step, std::int64_t stamp_ns, std::int64_t now_ns) {
    std::vector<std::uint32_t> id = {4, 7};
    std::vector<double> x = {1, 2};
    std::vector<double> y = {3, 4};
    std::vector<std::int64_t> stamps = {stamp_ns, stamp_ns};
    bus::HostState state{};
    state.writer = 2;
    state.host = 0;
    state.step = step;
    lend(state.resolved, id, x, y, stamps);
    model_.hear(state, now_ns, 0);
  }
  void send_world(std::uint64_t number, std::int64_t time_ns, std::int64_t now_ns,
                  std::vector<std::uint32_t> stale) {
    std::vector<std::uint32_t> id = {9};
    std::vector<double> zero = {0};
    std::vector<std::int64_t> stamps = {time_ns - kSecond};
    bus::World world{};
    world.writer = kManager;
    world.step = number;
    world.time_ns = time_ns;
    lend(world.robots, id, zero, zero, stamps);
    bus::borrow(world.stale, stale);
    model_.hear(world, now_ns);
  }

 private:
  static void lend(rave_wire_PlanarRobots& robots, std::vector<std::uint32_t>& id,
                   std::vector<double>& x, std::vector<double>& y,
                   std::vector<std::int64_t>& stamps) {
    bus::borrow(robots.id, id);
    bus::borrow(robots.x_m, x);
    bus::borrow(robots.y_m, y);
    bus::borrow(robots.yaw_rad, x);
    bus::borrow(robots.vx_mps, x);
    bus::borrow(robots.vy_mps, y);
    bus::borrow(robots.wz_radps, y);
    bus::borrow(robots.stamp_ns, stamps);
  }
};

TEST_F(LiveRunModelTest, ReportsAgainstWhatIsAskedFor) {
  // Each ten steps of 10 ms is asked for; each third report got lost.
  for (std::uint64_t i = 1; i <= 30; ++i) {
    if (i % 3 != 0) report(10 * i, 0, static_cast<std::int64_t>(i) * kSecond / 10);
  }
  const HostView left = host(0, 29 * kSecond / 10);
  EXPECT_DOUBLE_EQ(left.asked_rate_hz.value(), 10);
  EXPECT_NEAR(left.rate_hz.value(), 6.7, 0.3);
}

TEST_F(LiveRunModelTest, AgesAreThoseOfTheTimeOfTheRun) {
  send_world(1, 10 * kSecond, 100 * kSecond, {});
  report(10, 10 * kSecond - kSecond / 4, 100 * kSecond);
  EXPECT_DOUBLE_EQ(host(0, 100 * kSecond).age_s.value(), 0.25);
  EXPECT_DOUBLE_EQ(host(0, 101 * kSecond).age_s.value(), 1.25);
  EXPECT_DOUBLE_EQ(model_.view(101 * kSecond, false).time_s.value(), 11);
}

TEST_F(LiveRunModelTest, WorldsThatNeverCameAreCounted) {
  send_world(1, 0, 0, {});
  send_world(2, kSecond, kSecond, {});
  send_world(5, 4 * kSecond, 4 * kSecond, {});
  const HostView manager = model_.view(4 * kSecond, false).hosts[0];
  EXPECT_EQ(manager.lost, 2U);
  EXPECT_DOUBLE_EQ(manager.rate_hz.value(), 1);
}

TEST_F(LiveRunModelTest, StaleRobotsComeFirst) {
  report(10, 5 * kSecond, 6 * kSecond);
  send_world(1, 6 * kSecond, 6 * kSecond, {7});
  const auto robots = model_.view(6 * kSecond, true).robots;
  ASSERT_EQ(robots.size(), 3U);
  EXPECT_EQ(robots[0].number, 7U);
  EXPECT_TRUE(robots[0].stale);
  EXPECT_EQ(robots[0].host, "left");
  EXPECT_DOUBLE_EQ(robots[1].age_s.value(), 1);
}

TEST_F(LiveRunModelTest, RobotsThatTheWorldAloneShowsHaveTheirHostFromTheRoster) {
  report(10, 5 * kSecond, 6 * kSecond);
  send_world(1, 6 * kSecond, 6 * kSecond, {});
  model_.hear(entry_of(3, 9, 1, "nina"));
  model_.hear(entry_of(3, 4, 1, "eve"));
  const auto robots = model_.view(6 * kSecond, true).robots;
  ASSERT_EQ(robots.size(), 3U);
  for (const RobotView& robot : robots) {
    EXPECT_EQ(robot.host, robot.number == 9 ? "right" : "left") << robot.number;
    EXPECT_EQ(robot.name, robot.number == 9 ? "nina" : "") << "only its own host names a robot";
  }
}

TEST_F(LiveRunModelTest, ClocksAsTheManagerKnowsThem) {
  sights_[0].offset_s = 0.002;
  sights_[0].bound_s = 0.0001;
  tell(5, kSecond);
  EXPECT_DOUBLE_EQ(host(0, kSecond).offset_s.value(), 0.002);
  EXPECT_DOUBLE_EQ(host(0, kSecond).bound_s.value(), 0.0001);
  EXPECT_FALSE(host(1, kSecond).offset_s);
}

}  // namespace
}  // namespace rave::watch
