// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/page.hpp"

#include <gtest/gtest.h>

#include "rave/base/text_width.hpp"
#include "short_text.hpp"

namespace rave::watch {
namespace {

RunView example() {
  RunView view;
  view.run = "1a2b3c4d00000000";
  view.scenario = "flock";
  view.timing = Timing::kRealTime;
  view.phase = Phase::kRunning;
  view.time_s = 12.34;
  view.duration_s = 60;
  view.speed = 1;
  HostView manager;
  manager.name = "environment manager";
  manager.manager = true;
  manager.machine = "lab-1";
  manager.standing = Standing::kHere;
  manager.rate_hz = 20;
  manager.lost = 0;
  manager.cores = 0.031;
  view.hosts.push_back(manager);
  HostView left;
  left.name = "left";
  left.machine = "lab-2";
  left.standing = Standing::kHere;
  left.robots = 12;
  left.real_robots = 2;
  left.rate_hz = 7.5;
  left.asked_rate_hz = 10;
  left.age_s = 0.103;
  left.delay_s = 0.0004;
  left.round_trip_s = 0.00082;
  left.offset_s = 0.0012;
  left.bound_s = 0.0004;
  left.lost = 0;
  left.refused = 0;
  left.cores = 0.47;
  left.memory_mb = 61;
  left.process = 4711;
  view.hosts.push_back(left);
  HostView right = left;
  right.name = "right";
  right.standing = Standing::kGone;
  right.lost = 3;
  view.hosts.push_back(right);
  return view;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(Page, IsNeverWiderOrHigherThanItsTerminal) {
  RunView view = example();
  view.text = std::string(300, 'w');
  for (int i = 0; i < 40; ++i) view.hosts.push_back(view.hosts[1]);
  view.robots.resize(100);
  for (const std::size_t width : {1U, 9U, 40U, 80U, 160U}) {
    for (const std::size_t height : {0U, 1U, 5U, 24U}) {
      const auto lines = render_page(view, {width, height, false, "q quit"});
      for (const std::string& line : lines) EXPECT_LE(columns_of(line), width) << line;
      if (height > 0) {
        EXPECT_LE(lines.size(), height);
      }
    }
  }
}

TEST(Page, ANarrowOneKeepsWhatMattersMost) {
  EXPECT_EQ(text_of(render_page(example(), {60, 0, false, ""})),
            "flock   running   12.34 of 60.00 s   1.00x   in real time\n"
            "\n"
            "HOST     STATE  REAL+SIM    RATE /s     AGE  LOST  CPU\n"
            "manager  here                  20.0             0   3%\n"
            "left     here       2+10  7.50/10.0  103 ms     0  47%\n"
            "right    gone       2+10  7.50/10.0  103 ms     3  47%\n"
            "\n"
            "here   waiting not in the run yet   late silent   gone\n");
}

TEST(Page, AWideOneHasAll) {
  const std::string text = text_of(render_page(example(), {160, 0, false, "q quit"}));
  for (const char* const word :
       {"MACHINE", "lab-2", "CLOCK", "+1.20±0.40 ms", "TRIP", "820 us", "DELAY", "400 us", "CPU",
        "47%", "61 MB", "4711", "run 1a2b3c4d", "dropped gone for good"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  }
  EXPECT_EQ(text.find("STEP"), std::string::npos) << "a column without any text";
  EXPECT_TRUE(text.ends_with("q quit\n"));
}

TEST(Page, ShowsWhoComesLateAndWhatTakesTheTime) {
  RunView view = example();
  view.speed = 0.06;
  view.hosts[1].missed_pct = 94.2;
  view.hosts[1].late_phase = "decide";
  view.hosts[2].missed_pct = 0.4;
  const std::string text = text_of(render_page(view, {80, 0, false, ""}));
  EXPECT_NE(text.find("0.06x"), std::string::npos) << text;
  EXPECT_NE(text.find("LATE"), std::string::npos) << text;
  EXPECT_NE(text.find("94% decide"), std::string::npos) << text;
  EXPECT_NE(text.find("0.4%"), std::string::npos) << text;
}

TEST(Page, RowsThatDoNotFitAreCounted) {
  RunView view = example();
  for (int i = 0; i < 20; ++i) view.hosts.push_back(view.hosts[1]);
  const auto lines = render_page(view, {80, 12, false, ""});
  ASSERT_EQ(lines.size(), 12U);
  EXPECT_EQ(lines[9], "and 17 more");
}

TEST(Page, ColoursGoByState) {
  const std::string text = text_of(render_page(example(), {80, 0, true, ""}));
  EXPECT_NE(text.find("\x1b[32mhere\x1b[0m"), std::string::npos);
  EXPECT_NE(text.find("\x1b[1;31mgone\x1b[0m"), std::string::npos);
  EXPECT_NE(text.find("\x1b[33m7.50/10.0\x1b[0m"), std::string::npos) << "less than is asked for";
  const std::string plain = text_of(render_page(example(), {80, 0, false, ""}));
  EXPECT_EQ(plain.find('\x1b'), std::string::npos);
}

TEST(Page, RobotsHaveATableOfTheirOwn) {
  RunView view = example();
  RobotView robot;
  robot.number = 7;
  robot.host = "left";
  robot.team = "blue";
  robot.age_s = 2.5;
  robot.stale = true;
  view.robots.push_back(robot);
  const std::string text = text_of(render_page(view, {80, 0, false, ""}));
  EXPECT_NE(text.find("ROBOT  TEAM  ON HOST  STATE    AGE\n#7     blue  left     stale  2.5 s\n"),
            std::string::npos)
      << text;
  view.robots[0].driver = "anna";
  const std::string driven = text_of(render_page(view, {80, 0, false, ""}));
  EXPECT_NE(driven.find("ON HOST  DRIVER  STATE"), std::string::npos) << driven;
  EXPECT_NE(driven.find("left     anna    stale"), std::string::npos) << driven;
}

}  // namespace
}  // namespace rave::watch
