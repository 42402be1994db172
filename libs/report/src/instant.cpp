// SPDX-License-Identifier: Apache-2.0
// What robots and sensors see at one moment.
#include <algorithm>
#include <cmath>

#include "stage.hpp"

namespace rave::report {
namespace {

/// Consecutive hits with a common start: the start, then the ends, on the page.
struct Fan {
  Vec2 from_W;
  std::vector<Vec2> outline;
};

std::vector<Fan> fans_of(const Stage& stage) {
  std::vector<Fan> fans;
  for (const PictureHit& hit : stage.picture.instant->hits) {
    if (fans.empty() || !(hit.from_W == fans.back().from_W)) {
      fans.push_back({hit.from_W, {stage.panel.to_page(hit.from_W)}});
    }
    fans.back().outline.push_back(stage.panel.to_page(hit.to_W));
  }
  return fans;
}

/// The robot with the laser: the one nearest to the start of its rays; null without robots.
const PictureRobot* owner_of(const PictureInstant& instant, Vec2 from_W) {
  const auto nearest = std::min_element(instant.robots.begin(), instant.robots.end(),
                                        [&](const PictureRobot& a, const PictureRobot& b) {
                                          return squared_norm(a.X_WB.position() - from_W) <
                                                 squared_norm(b.X_WB.position() - from_W);
                                        });
  return nearest == instant.robots.end() ? nullptr : &*nearest;
}

/// The areas covered by rays; so faint that a dozen of them on top of each other stay light.
void draw_fans(Stage& stage) {
  const auto fans = fans_of(stage);
  if (fans.size() > kMostFans) return;
  for (const Fan& fan : fans) {
    if (fan.outline.size() < 3) continue;
    const PictureRobot* owner = owner_of(*stage.picture.instant, fan.from_W);
    const bool is_strong =
        owner != nullptr && (owner->kind == Kind::kRecordedRobot || owner->kind == Kind::kSensor);
    const Rgb colour =
        is_strong ? rgb_of(owner->colour, owner->kind) : rgb_of("", Kind::kSimulatedRobot);
    stage.pen.path(fan.outline, true);
    stage.pen.fill_keeping_path(colour, is_strong ? 0.08 : 0.035);
    stage.pen.stroke(colour, 0.5, is_strong ? 0.25 : 0.12);
  }
}

/// The hits on one kind of body, thinned where neighbours of a scan would overlap.
std::vector<Vec2> places_of_hits(const Stage& stage, Kind kind) {
  constexpr double kLeastSpacing = 2.6;
  std::vector<Vec2> places;
  const PictureHit* last = nullptr;
  for (const PictureHit& hit : stage.picture.instant->hits) {
    const Vec2 at = stage.panel.to_page(hit.to_W);
    if (hit.kind != kind || !stage.panel.frame.contains(at)) continue;
    const bool is_same_scan = last != nullptr && last->from_W == hit.from_W;
    // Hits of different scans are never thinned: two robots may see the same wall.
    if (is_same_scan && squared_norm(at - places.back()) < kLeastSpacing * kLeastSpacing) continue;
    places.push_back(at);
    last = &hit;
  }
  return places;
}

/// The largest distance of the outline from the robot's origin, for the heading mark.
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
  // A white border first, so that robots that touch each other can be distinguished.
  pen.stroke_keeping_path(kWhite, 2.6, 0.9);
  pen.fill_keeping_path(is_light ? lighter(colour, 0.75) : colour);
  pen.stroke(colour, 1.1);
  pen.line(centre, nose);
  pen.stroke(is_light ? colour : kWhite, is_light ? 1.1 : 1.5);
}

void draw_hits(Pen& pen, const std::vector<Vec2>& places, Kind kind) {
  if (places.empty()) return;
  // One path for all: thousands of elements would make an SVG of megabytes.
  constexpr double kSize = 1.35;
  std::vector<Vec2> corners;
  switch (kind) {
    case Kind::kVirtualObstacle:
      corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
      break;
    case Kind::kSimulatedRobot:
      corners = {{0, -1.5}, {1.5, 0}, {0, 1.5}, {-1.5, 0}};
      break;
    default:
      corners = {{-0.45, -1}, {0.45, -1}, {1, -0.45}, {1, 0.45},
                 {0.45, 1},   {-0.45, 1}, {-1, 0.45}, {-1, -0.45}};
  }
  pen.polygons(corners, kSize, places);
  const Rgb colour = rgb_of(palette_for(kind).colour);
  pen.stroke_keeping_path(kWhite, 0.9, 0.85);
  pen.fill(kind == Kind::kSimulatedRobot ? rgb_of("#5b6478") : colour);
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
  // What covers most is drawn first; hits last, since they are small and the point of the picture.
  draw_fans(stage);
  draw_trails(stage, instant.t_s);
  draw_bodies(stage, false);
  draw_bodies(stage, true);
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
  for (const Kind kind : kAllKinds) {
    const std::vector<Vec2> places = places_of_hits(stage, kind);
    for (const Vec2 at : places) stage.labels.weigh(at, kStrongWeight);
    draw_hits(stage.pen, places, kind);
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
  // Real robots and hunters get the free places first; the others are labelled only if all can be.
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
