// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "stage.hpp"

namespace rave::report {
namespace {

constexpr Rgb kFan = {0.93, 0.75, 0.15};

/// The ends of each run of hits that share their start.
std::vector<std::vector<Vec2>> fans_of(const Stage& stage) {
  std::vector<std::vector<Vec2>> fans;
  const std::vector<PictureHit>& hits = stage.picture.instant->hits;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (i == 0 || !(hits[i].from_W == hits[i - 1].from_W)) {
      fans.push_back({stage.panel.to_page(hits[i].from_W)});
    }
    fans.back().push_back(stage.panel.to_page(hits[i].to_W));
  }
  return fans;
}

void draw_fans(Stage& stage) {
  const auto fans = fans_of(stage);
  if (fans.size() > kMostFans) return;
  for (const auto& fan : fans) {
    if (fan.size() < 3) continue;
    stage.pen.path(fan, true);
    stage.pen.fill(kFan, 0.07);
  }
}

/// The outermost distance of the outline from the robot's own point: where the nose goes.
double reach_of(const PictureRobot& robot) {
  double squared_reach = 0;
  for (const Vec2 corner : robot.outline_W) {
    squared_reach = std::max(squared_reach, squared_norm(corner - robot.X_WB.position()));
  }
  return std::sqrt(squared_reach);
}

Vec2 nose_of(const PictureRobot& robot, const Panel& panel) {
  cairo_matrix_t turn;
  cairo_matrix_init_rotate(&turn, robot.X_WB.yaw);
  Vec2 ahead = {reach_of(robot), 0};
  cairo_matrix_transform_distance(&turn, &ahead.x, &ahead.y);
  return panel.to_page(robot.X_WB.position() + ahead);
}

}  // namespace

void draw_robot(Pen& pen, const std::vector<Vec2>& outline, Vec2 centre, Vec2 nose, Kind kind,
                Rgb colour) {
  const bool is_light = kind != Kind::kRecordedRobot && kind != Kind::kHunter;
  pen.path(outline, true);
  pen.stroke_keeping_path(kWhite, 2.6, 0.9);
  pen.fill_keeping_path(is_light ? lighter(colour, 0.75) : colour);
  pen.stroke(colour, 1.1);
  pen.line(centre, nose);
  pen.stroke(is_light ? colour : kWhite, is_light ? 1.1 : 1.5);
}

void draw_hit(Pen& pen, Vec2 at, Kind kind) {
  constexpr double kSize = 1.45;
  switch (kind) {
    case Kind::kVirtualObstacle:
      pen.box({at.x - kSize, at.y - kSize, at.x + kSize, at.y + kSize});
      break;
    case Kind::kRecordedRobot:
    case Kind::kHunter:
      pen.path(
          {at + 1.5 * kSize * Vec2{0, -1}, at + kSize * Vec2{1.4, 1}, at + kSize * Vec2{-1.4, 1}},
          true);
      break;
    case Kind::kSimulatedRobot:
      pen.path({at + 1.5 * kSize * Vec2{0, -1}, at + 1.5 * kSize * Vec2{1, 0},
                at + 1.5 * kSize * Vec2{0, 1}, at + 1.5 * kSize * Vec2{-1, 0}},
               true);
      break;
    default:
      pen.disc(at, kSize);
  }
  pen.fill_keeping_path(rgb_of(palette_for(kind).colour));
  pen.stroke(kWhite, 0.35);
}

void draw_sighting(Pen& pen, Vec2 from, Vec2 to, const std::optional<Vec2>& tube, Rgb colour) {
  pen.line(from, to);
  pen.stroke(colour, 0.75, 0.8);
  if (tube) {
    pen.line(to, *tube);
    pen.stroke(kInk, 0.9);
  }
  pen.disc(to, 2.3);
  pen.fill_keeping_path(kWhite);
  pen.stroke(colour, 1.1);
}

void draw_instant(Stage& stage) {
  const PictureInstant& instant = *stage.picture.instant;
  draw_fans(stage);
  draw_trails(stage, instant.t_s);
  draw_bodies(stage);
  for (const PictureSighting& sighting : instant.sightings) {
    std::optional<Vec2> tube;
    if (sighting.tube_W) tube = stage.panel.to_page(*sighting.tube_W);
    draw_sighting(stage.pen, stage.panel.to_page(sighting.from_W),
                  stage.panel.to_page(sighting.to_W), tube,
                  rgb_of(sighting.colour, Kind::kRecordedRobot));
  }
  for (const PictureRobot& robot : instant.robots) {
    draw_robot(stage.pen, to_page(stage.panel, robot.outline_W),
               stage.panel.to_page(robot.X_WB.position()), nose_of(robot, stage.panel), robot.kind,
               rgb_of(robot.colour, robot.kind));
  }
  for (const PictureHit& hit : instant.hits) {
    const Vec2 at = stage.panel.to_page(hit.to_W);
    if (!hit.kind || !stage.panel.frame.contains(at)) continue;
    draw_hit(stage.pen, at, *hit.kind);
    stage.labels.weigh(at);
  }
}

void label_instant(Stage& stage) {
  const PictureInstant& instant = *stage.picture.instant;
  for (const PictureRobot& robot : instant.robots) {
    stage.labels.block(bounds_of(to_page(stage.panel, robot.outline_W)));
  }
  const auto label = [&](const PictureRobot& robot, bool is_strong) {
    const PageBox box = bounds_of(to_page(stage.panel, robot.outline_W));
    Rgb colour = rgb_of(robot.colour, robot.kind);
    if (!is_strong) colour = kSoftInk;
    label_beside(
        stage, middle_of(box), 0.5 * std::max(box.width(), box.height()), robot.label,
        {.size = is_strong ? 9.0 : 7.0, .colour = colour, .bold = is_strong, .halo = true});
  };
  const auto is_strong = [](const PictureRobot& robot) {
    return robot.kind == Kind::kRecordedRobot || robot.kind == Kind::kHunter;
  };
  const auto strong = static_cast<std::size_t>(
      std::count_if(instant.robots.begin(), instant.robots.end(), is_strong));
  if (strong <= kMostLabels) {
    for (const PictureRobot& robot : instant.robots) {
      if (is_strong(robot)) label(robot, true);
    }
  }
  if (instant.robots.size() <= kMostLabels) {
    for (const PictureRobot& robot : instant.robots) {
      if (!is_strong(robot)) label(robot, false);
    }
  }
  if (instant.sightings.size() > kMostLabels) return;
  for (const PictureSighting& sighting : instant.sightings) {
    label_beside(
        stage, stage.panel.to_page(sighting.to_W), 3, sighting.label,
        {.size = 7, .colour = rgb_of(sighting.colour, Kind::kRecordedRobot), .halo = true});
  }
}

}  // namespace rave::report
