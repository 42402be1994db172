// SPDX-License-Identifier: Apache-2.0
#include "sample_picture.hpp"

namespace rave::report {
namespace {

PictureTrack straight(std::string label, Kind kind, Vec2 from_W, Vec2 velocity, double end_s) {
  PictureTrack track;
  track.label = std::move(label);
  track.kind = kind;
  for (int i = 0; 0.5 * i <= end_s; ++i) {
    const Vec2 p_W = from_W + (0.5 * i) * velocity;
    track.points.push_back({0.5 * i, {p_W.x, p_W.y, 0}});
  }
  return track;
}

PictureRobot robot_at(std::string label, Kind kind, Vec2 p_W) {
  return {square_W(p_W, 0.15), {p_W.x, p_W.y, 0.3}, kind, std::move(label), ""};
}

}  // namespace

std::vector<Vec2> square_W(Vec2 centre_W, double half_m) {
  return {centre_W + Vec2{-half_m, -half_m}, centre_W + Vec2{half_m, -half_m},
          centre_W + Vec2{half_m, half_m}, centre_W + Vec2{-half_m, half_m}};
}

Picture sample_picture() {
  Picture picture;
  picture.title = "Robots & <tubes>";
  picture.subtitle = "a small world";
  picture.caption = {"Recorded on a floor.", "Ωμέγα: text beyond ASCII."};
  picture.bodies = {{square_W({1, 4}, 0.1), Kind::kLandmark, "17", ""},
                    {square_W({3, 4}, 0.1), Kind::kLandmark, "18", ""},
                    {square_W({0, 2}, 0.2), Kind::kMappedWall, "", ""},
                    {square_W({4, 1}, 0.5), Kind::kVirtualObstacle, "crate", ""}};
  picture.tracks = {straight("robot 1", Kind::kRecordedRobot, {0, 0}, {0.05, 0.02}, 60),
                    straight("robot 2", Kind::kRecordedRobot, {4, 5}, {-0.05, -0.05}, 65),
                    straight("odometry 1", Kind::kRecordedRobot, {0, 0}, {0.05, 0.03}, 60),
                    straight("s1", Kind::kSimulatedRobot, {1, 1}, {0.02, 0.03}, 65),
                    straight("chaser", Kind::kHunter, {2, -1}, {0, 0.04}, 65)};
  picture.tracks[0].pose_lost_t_s = 60.0;
  picture.tracks[1].gaps = {{20, 21.5}};
  picture.tracks[2].odometry_only = true;
  PictureInstant instant;
  instant.t_s = 40;
  instant.robots = {robot_at("robot 1", Kind::kRecordedRobot, {2, 0.8}),
                    robot_at("s1", Kind::kSimulatedRobot, {1.8, 2.2}),
                    robot_at("chaser", Kind::kHunter, {2, 0.3})};
  for (const auto& [to_W, kind] :
       {std::pair<Vec2, std::optional<Kind>>{{3.5, 0.9}, Kind::kVirtualObstacle},
        {{3.5, 1.2}, Kind::kVirtualObstacle},
        {{1.9, 2.05}, Kind::kSimulatedRobot},
        {{1, 3.9}, Kind::kLandmark},
        {{4, 3}, std::nullopt}}) {
    instant.hits.push_back({{2, 0.8}, to_W, kind});
  }
  instant.sightings = {{{2, 0.8}, {1.1, 4.1}, Vec2{1, 4}, "", ""},
                       {{2, 0.8}, {3.3, 3.3}, std::nullopt, "code 43", ""}};
  picture.instant = instant;
  return picture;
}

}  // namespace rave::report
