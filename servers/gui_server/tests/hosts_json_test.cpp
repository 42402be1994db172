// SPDX-License-Identifier: Apache-2.0
#include "live/hosts_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace rave::gui_server {
namespace {

using HostsJson = nlohmann::json;

HostsJson one(const watch::HostView& host) {
  watch::RunView view;
  view.hosts.push_back(host);
  return HostsJson::parse(hosts_json(view)).at(0);
}

TEST(HostsJson, HasTheWordsOfTheTerminal) {
  watch::HostView host;
  host.name = "host-1";
  const std::pair<watch::Standing, const char*> words[] = {{watch::Standing::kWaiting, "waiting"},
                                                           {watch::Standing::kHere, "here"},
                                                           {watch::Standing::kLate, "late"},
                                                           {watch::Standing::kGone, "gone"},
                                                           {watch::Standing::kDropped, "dropped"}};
  for (const auto& [standing, word] : words) {
    host.standing = standing;
    EXPECT_EQ(one(host).at("state"), word);
  }
}

TEST(HostsJson, HasTheColumnsOfTheTerminal) {
  watch::HostView host;
  host.name = "host-1";
  host.age_s = 0.01;
  host.round_trip_s = 0.0002;
  host.offset_s = -0.003;
  host.bound_s = 0.0001;
  host.refused = 2;
  host.missed_pct = 12.5;
  host.late_phase = "drivers";
  host.memory_mb = 84.2;
  host.process = 4711;
  const HostsJson json = one(host);
  EXPECT_EQ(json.at("age_s"), 0.01);
  EXPECT_EQ(json.at("trip_s"), 0.0002);
  EXPECT_EQ(json.at("clock_s"), -0.003);
  EXPECT_EQ(json.at("clock_bound_s"), 0.0001);
  EXPECT_EQ(json.at("refused"), 2);
  EXPECT_EQ(json.at("missed_pct"), 12.5);
  EXPECT_EQ(json.at("late_phase"), "drivers");
  EXPECT_EQ(json.at("memory_mb"), 84.2);
  EXPECT_EQ(json.at("pid"), 4711);
}

TEST(HostsJson, WhatIsNotKnownIsLeftOut) {
  const HostsJson json = one({});
  for (const char* const key :
       {"age_s", "trip_s", "clock_s", "refused", "missed_pct", "late_phase", "memory_mb", "pid"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
}

}  // namespace
}  // namespace rave::gui_server
