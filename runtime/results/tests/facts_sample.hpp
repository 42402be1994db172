// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/results/facts_file.hpp"

namespace rave::runtime::testing {

inline FactsOf sample_whose() { return {7, "left"}; }

/// What a host may know of one of four robots, among eight bodies of which the robots are the last.
inline RunFacts sample_facts(std::uint32_t robot) {
  RunFacts facts;
  facts.steps = 300;
  facts.problems = {"the record is not whole: no room"};
  facts.events = {{3, RobotId(robot), sim::EventKind::kContact, BodyId(1), "", 0},
                  {9, RobotId(robot), sim::EventKind::kGuardSlowed, BodyId(), "fence", 8}};
  facts.robots = {{robot, "wander", 30, true, true, false, 1.5, -0.0, 3.1, 2'990'000'000, 1.25}};
  facts.devices = {{robot, "line", "create_oi", R"({"packets": 3})"}};
  facts.streams = {{robot, "camera", "utias_camera", "{}"}};
  facts.transmitters = {{robot, "radio", "in_process", ""}};
  facts.radio.sent = robot + 1;
  facts.radio.overrun = 2;
  facts.inputs_by_hand = 1;
  facts.lateness = {300, 4 + robot, 25'000'000, 1, {{"decide", 3}, {"machine", 1 + robot}}};
  facts.poses = {10 + robot, 20'000'000 + robot, 150'000'000};
  facts.hits = {{"simulated", {{"nothing", 5}, {"real", robot}}}};
  facts.closest = {{"real-simulated", {0.5 - 0.1 * robot, 0.75, 1.25, 4 + robot, 1}}};
  facts.sightings = SightingFacts{{{"anna", {5, 4, 1}}}, {{77, 1}}};
  facts.goals = {{robot, 0}, {{robot}, {}}, {{true, 0.5, std::nullopt}, {robot == 1, 0.25, 1.5}}};
  facts.capture = CaptureFacts{{{RobotId(robot), RobotId(0), 2.5 + robot, 0.1}}, 0.1};
  report::PictureTrack track;
  track.label = "r";
  track.points = {{0, {0, 0, 0}}, {0.1, {1, 2, 3}}};
  track.gaps = {{0.02, 0.04}};
  track.pose_lost_t_s = 0.09;
  facts.tracks = {{robot, track}};
  track.odometry_only = true;
  facts.tracks.push_back({robot, track});
  InstantRobot shown;
  shown.robot = robot;
  shown.bodies.push_back(
      {{{0, 0}, {1, 0}, {0, 1}}, {1, 2, 3}, report::Kind::kHunter, "r", "#112233"});
  shown.hits.push_back({{0, 0}, {1, 1}, report::Kind::kLandmark});
  report::PictureSighting sighting;
  sighting.tube_W = Vec2{2, 3};
  facts.instant = InstantFacts{1.5, {shown}, {{robot, robot, sighting}}};
  facts.maps = {{robot, 0.05, {-3.2, 6.4}, 128, 64, 1, 0, 2'000'000'000, {}}};
  facts.maps.front().cells.assign(64 * 64, 255);
  facts.maps.front().cells[robot] = 100;
  facts.shadows = {{robot, R"({"robot": "r"})"}};
  facts.world = WorldFacts{robot,
                           300,
                           {{5, RobotId(1), sim::EventKind::kContact, BodyId(0), "", 0}},
                           CaptureFacts{{{RobotId(1), RobotId(0), 3.5, 0.1}}, 0.1}};
  return facts;
}

}  // namespace rave::runtime::testing
