// SPDX-License-Identifier: Apache-2.0
// What hosts say of their run and of their robots, for those who hear no manager.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/watch/run_model.hpp"

namespace rave::watch {
namespace {

constexpr std::int64_t kMoment = 1'000'000'000;

bus::HostInfo host_info(std::uint64_t writer, std::uint32_t host, const char* name) {
  bus::HostInfo info{};
  info.writer = writer;
  info.host = host;
  bus::put_text(info.name, name);
  info.clock = rave_wire_CLOCK_LOCK_STEP;
  info.robots = 3;
  return info;
}

/// Somebody who hears no manager, but what hosts say.
class HostWordsTest : public ::testing::Test {
 protected:
  HostWordsTest() {
    model_.hear(host_info(2, 0, "left"));
    model_.hear(host_info(3, 1, "right"));
  }
  void say(std::uint64_t writer, std::uint64_t step, rave_wire_RunPhase phase,
           std::string_view text = "", bool manager = true) {
    bus::RunState state{};
    state.writer = writer;
    bus::put_text(state.scenario, "flock");
    state.phase = phase;
    state.step = step;
    state.steps = 6000;
    state.step_s = 0.01;
    state.speed = 2;
    bus::put_text(state.text, text);
    std::vector<rave_wire_HostSight> sights(1);
    sights[0].host = rave_wire_kNone;
    bus::put_text(sights[0].name, "environment manager");
    sights[0].phase = manager ? rave_wire_HOST_RUNS : rave_wire_HOST_LOST;
    bus::borrow(state.hosts, sights);
    model_.hear_word(state, kMoment);
  }
  [[nodiscard]] RunView view() const { return model_.view(kMoment, false); }

  RunModel model_{"run"};
};

TEST_F(HostWordsTest, TellWhereTheRunIs) {
  say(2, 100, rave_wire_RUN_RUNNING);
  say(3, 102, rave_wire_RUN_RUNNING);
  EXPECT_EQ(view().phase, Phase::kRunning);
  EXPECT_EQ(view().scenario, "flock");
  EXPECT_EQ(view().step, 102U);
  EXPECT_DOUBLE_EQ(view().time_s.value_or(0), 1.02);
  EXPECT_DOUBLE_EQ(view().duration_s.value_or(0), 60);
  ASSERT_EQ(view().hosts.size(), 3U);
  EXPECT_TRUE(view().hosts[0].manager);
  EXPECT_EQ(view().hosts[0].standing, Standing::kHere);
}

TEST_F(HostWordsTest, OneThatWaitsCountsForAll) {
  say(2, 100, rave_wire_RUN_RUNNING);
  say(3, 100, rave_wire_RUN_WAITS, "waits for left");
  EXPECT_EQ(view().phase, Phase::kWaits);
  EXPECT_EQ(view().text, "waits for left");
}

TEST_F(HostWordsTest, AManagerThatIsGoneIsWaitedFor) {
  say(2, 100, rave_wire_RUN_RUNNING, "", false);
  say(3, 100, rave_wire_RUN_RUNNING, "", false);
  EXPECT_EQ(view().phase, Phase::kWaits);
  EXPECT_EQ(view().text, "the environment manager is lost");
  EXPECT_EQ(view().hosts[0].standing, Standing::kGone);
}

TEST_F(HostWordsTest, TheRunIsOverWhenAllHaveEnded) {
  say(2, 5999, rave_wire_RUN_ENDED);
  say(3, 5998, rave_wire_RUN_RUNNING);
  EXPECT_EQ(view().phase, Phase::kRunning);
  say(3, 5999, rave_wire_RUN_FAILED, "a driver failed");
  EXPECT_EQ(view().phase, Phase::kFailed);
  EXPECT_EQ(view().text, "a driver failed");
}

TEST_F(HostWordsTest, AnotherRunOfTheNameCountsFromItsBeginning) {
  say(2, 5999, rave_wire_RUN_ENDED);
  say(3, 5999, rave_wire_RUN_ENDED);
  model_.lose(2);
  model_.lose(3);
  EXPECT_EQ(view().phase, Phase::kEnded);
  say(4, 7, rave_wire_RUN_RUNNING);
  EXPECT_EQ(view().phase, Phase::kRunning);
  EXPECT_EQ(view().step, 7U);
}

TEST_F(HostWordsTest, TellWhereRecordingsAreAlsoThatOfTheManager) {
  bus::HostInfo info = host_info(2, 0, "left");
  bus::put_text(info.machine, "lab-2");
  bus::put_text(info.folder, "/runs/left");
  model_.hear(info);
  bus::RunState state{};
  state.writer = 3;
  state.phase = rave_wire_RUN_RUNNING;
  state.step_s = 0.01;
  std::vector<rave_wire_HostSight> sights(1);
  sights[0].host = rave_wire_kNone;
  bus::put_text(sights[0].name, "environment manager");
  bus::put_text(sights[0].machine, "lab-1");
  bus::put_text(sights[0].folder, "/runs/env");
  bus::borrow(state.hosts, sights);
  model_.hear_word(state, kMoment);
  // `right` makes no recording.
  const std::vector<KeptAt> kept = {{"environment manager", true, "lab-1", "/runs/env"},
                                    {"left", false, "lab-2", "/runs/left"}};
  EXPECT_EQ(model_.kept(), kept);
  // A recording stays when its process has left.
  model_.lose(2);
  EXPECT_EQ(model_.kept(), kept);
}

TEST_F(HostWordsTest, WhatAManagerSaysCountsMore) {
  bus::RunState told{};
  told.writer = 1;
  told.phase = rave_wire_RUN_RUNNING;
  told.step = 50;
  told.step_s = 0.01;
  model_.hear(told, kMoment);
  bus::RunState state{};
  state.writer = 2;
  state.phase = rave_wire_RUN_WAITS;
  state.step = 100;
  state.step_s = 0.01;
  model_.hear_word(state, kMoment);
  EXPECT_EQ(view().step, 50U);
}

TEST_F(HostWordsTest, RobotsReportWhoTheyAreAndHowSure) {
  std::vector<std::uint32_t> id{1};
  std::vector<double> x{2};
  std::vector<double> y{3};
  std::vector<double> variance{0.25};
  std::vector<std::uint8_t> flags{1 | 4 | 8};
  bus::HostState state{};
  state.writer = 2;
  bus::borrow(state.reports.id, id);
  bus::borrow(state.reports.x_m, x);
  bus::borrow(state.reports.y_m, y);
  bus::borrow(state.reports.yaw_rad, y);
  bus::borrow(state.reports.variance_xy_m2, variance);
  bus::borrow(state.reports.variance_yaw_rad2, variance);
  bus::borrow(state.reports.flags, flags);
  model_.hear(state, kMoment, 0);
  const RunView seen = model_.view(kMoment, true);
  const auto robot = std::ranges::find(seen.robots, 1U, &RobotView::number);
  ASSERT_NE(robot, seen.robots.end());
  ASSERT_TRUE(robot->report.has_value());
  EXPECT_EQ(robot->report->x_m, 2);
  EXPECT_EQ(robot->report->variance_xy_m2, 0.25);
  EXPECT_TRUE(robot->report->known);
  EXPECT_TRUE(robot->report->stopped);
  EXPECT_FALSE(robot->report->armed);
  EXPECT_FALSE(robot->report->real);
}

}  // namespace
}  // namespace rave::watch
