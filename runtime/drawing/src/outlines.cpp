// SPDX-License-Identifier: Apache-2.0
#include "outlines.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::drawing {
namespace {

constexpr int kDiscCorners = 48;

double area_m2(const std::vector<Vec2>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  return std::abs(twice) / 2;
}

}  // namespace

std::vector<Vec2> disc_outline(Vec2 centre_W, double radius_m) {
  std::vector<Vec2> corners;
  for (int i = 0; i < kDiscCorners; ++i) {
    corners.push_back(centre_W + radius_m * rotate(2 * kPi * i / kDiscCorners, {1, 0}));
  }
  return corners;
}

std::vector<Vec2> outline_of(const world::Shape& shape, const Pose2& X_WB) {
  if (shape.kind == world::ShapeKind::kDisc) {
    return disc_outline(transform(X_WB, shape.centre), shape.radius_m);
  }
  std::vector<Vec2> corners;
  for (const Vec2 corner : shape.vertices()) corners.push_back(transform(X_WB, corner));
  return corners;
}

void add_robot(const world::Body& body, const Pose2& X_WR, report::Kind kind,
               report::Picture& picture) {
  std::vector<std::vector<Vec2>> outlines;
  for (const world::Shape& shape : body.shapes) outlines.push_back(outline_of(shape, X_WR));
  if (outlines.empty()) return;
  const auto largest =
      std::max_element(outlines.begin(), outlines.end(),
                       [](const auto& a, const auto& b) { return area_m2(a) < area_m2(b); });
  picture.instant->robots.push_back({*largest, X_WR, kind, body.name, body.colour});
  for (auto outline = outlines.begin(); outline != outlines.end(); ++outline) {
    if (outline != largest) picture.bodies.push_back({*outline, report::Kind::kRobotPart, "", ""});
  }
}

report::Kind kind_of(const world::Body& body) {
  if (body.code) return report::Kind::kLandmark;
  return body.layer == Layer::kMappedReal ? report::Kind::kMappedWall
                                          : report::Kind::kVirtualObstacle;
}

}  // namespace rave::drawing
