// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

constexpr std::string_view kFiveRobots = R"(
name: lab
robots:
  - name: a
    robot: &robot {body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]}}
    poses: [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
  - {name: b, robot: *robot, pose: {x_m: 3}}
  - {name: c, robot: *robot, pose: {x_m: 4}}
)";

Result<std::vector<PlannedHost>> plan_of(const std::string& more) {
  RAVE_TRY_ASSIGN(const auto scenario,
                  expand_scenario_text(std::string(kFiveRobots) + more, "lab.yaml"));
  return plan_hosts(scenario);
}

std::string plan_error(const std::string& more) {
  const auto hosts = plan_of(more);
  return hosts ? "none" : hosts.error().text();
}

using Robots = std::vector<std::size_t>;

TEST(PlanHosts, NobodyUnlessAsked) {
  const auto hosts = plan_of("");
  ASSERT_TRUE(hosts) << hosts.error().text();
  EXPECT_TRUE(hosts->empty());
}

TEST(PlanHosts, ProcessesShareEvenlyInOrder) {
  const auto hosts = plan_of("processes: 2\n");
  ASSERT_TRUE(hosts) << hosts.error().text();
  ASSERT_EQ(hosts->size(), 2U);
  EXPECT_EQ((*hosts)[0], (PlannedHost{"host-1", {0, 1}, false}));
  EXPECT_EQ((*hosts)[1], (PlannedHost{"host-2", {2, 3, 4}, false}));
}

TEST(PlanHosts, ByNameOfRobotAndOfEntry) {
  const auto hosts = plan_of(
      "hosts:\n"
      "  - {name: rest, elsewhere: true}\n"
      "  - {name: one, robots: [a-2, c]}\n"
      "  - {name: two, robots: [b]}\n");
  ASSERT_TRUE(hosts) << hosts.error().text();
  EXPECT_EQ((*hosts)[0], (PlannedHost{"rest", {0, 2}, true}));
  EXPECT_EQ((*hosts)[1], (PlannedHost{"one", {1, 4}, false}));
  EXPECT_EQ((*hosts)[2], (PlannedHost{"two", {3}, false}));
}

TEST(PlanHosts, TheWholeEntry) {
  const auto hosts = plan_of("hosts: [{name: one, robots: [a]}, {name: two, robots: [b, c]}]\n");
  ASSERT_TRUE(hosts) << hosts.error().text();
  EXPECT_EQ((*hosts)[0].robots, (Robots{0, 1, 2}));
}

TEST(PlanHosts, BadInputNamesItsPlace) {
  EXPECT_EQ(plan_error("hosts: [{name: one, robots: [d]}]\n"),
            "lab.yaml:9:30: there is no robot `d`; did you mean `a`?");
  EXPECT_EQ(plan_error("hosts: [{name: one, robots: [a]}, {name: two, robots: [a-1]}]\n"),
            "lab.yaml:9:56: robot `a-1` is given to host `two`, but `one` already has it");
  EXPECT_EQ(plan_error("hosts: [{name: one, robots: [a]}]\n"),
            "lab.yaml:9:16: no host has robot `b`; a host without `robots` gets all that no other "
            "has");
  EXPECT_EQ(plan_error("hosts: [{name: one}, {name: two}]\n"),
            "lab.yaml:9:29: the hosts `one` and `two` name no robots; only one host may do so, and "
            "gets the rest");
  EXPECT_EQ(plan_error("hosts: [{name: one, robots: [a, b, c]}, {name: two}]\n"),
            "lab.yaml:9:48: host `two` has no robot: the other hosts have all");
  EXPECT_EQ(plan_error("processes: 6\n"),
            "lab.yaml:9:12: `processes`: found 6, expected at most one per robot, of which there "
            "are 5");
  EXPECT_EQ(plan_error("processes: 2\nhosts: [{name: one}]\n"),
            "lab.yaml:9:12: expected `processes` or `hosts`, not both");
  EXPECT_EQ(
      plan_error("on_lost_host: weit\n"),
      "lab.yaml:9:15: `on_lost_host`: found the text \"weit\", expected one of wait, drop and "
      "restart; did you mean `wait`?");
}

TEST(PlanHosts, WhatIsWrittenBackGivesTheSame) {
  const auto scenario =
      expand_scenario_text(std::string(kFiveRobots) +
                               "hosts: [{name: one, robots: [a]}, {name: two, elsewhere: true}]\n" +
                               "on_lost_host: restart\nhost_timeout_s: 2.5\n",
                           "lab.yaml");
  ASSERT_TRUE(scenario) << scenario.error().text();
  const auto again = expand_scenario_text(write_expanded(*scenario), "other.yaml");
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(plan_hosts(*again).value(), plan_hosts(*scenario).value());
  EXPECT_EQ(again->scenario.on_lost_host, LostHost::kRestart);
  EXPECT_EQ(again->scenario.host_timeout_s, 2.5);
}

}  // namespace
}  // namespace rave::config
