// SPDX-License-Identifier: Apache-2.0
// Bodies of the world, and labels beside what they name.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stage.hpp"

namespace rave::report {
namespace {

/// Smaller bodies are drawn as a dot of this radius, to stay visible.
constexpr double kLeastRadius = 1.4;

void hatch(Pen& pen, const std::vector<Vec2>& outline, Rgb colour) {
  const PageBox box = bounds_of(outline);
  pen.path(outline, true);
  pen.clip_to_path();
  constexpr double kSpacing = 4;
  const double reach = box.height();
  // Bounds the number of lines for a body that fills the page at a high zoom.
  const double spacing = std::max(kSpacing, (box.width() + reach) / 200);
  std::vector<Vec2> ends;
  // Lines at 45 degrees, from the lower edge to the upper one; the clip cuts them to the outline.
  for (double x = box.x0 - reach; x < box.x1; x += spacing) {
    ends.push_back({x, box.y1});
    ends.push_back({x + reach, box.y0});
  }
  pen.segments(ends);
  pen.stroke(colour, 0.7, 0.8);
  pen.unclip();
}

/// Points on the middle line of a body, its middle first, and half its width across that line. A
/// body that is not much longer than wide has its middle alone: labels stand around it.
struct Spine {
  std::vector<Vec2> points;
  double half_width = 0;
  bool is_straight = true;  ///< Along an axis of the page, or one point.
};

/// The longest edge of an outline as a unit vector.
Vec2 direction_of(const std::vector<Vec2>& outline) {
  Vec2 longest = {1, 0};
  double squared_length = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    if (squared_norm(edge) <= squared_length) continue;
    squared_length = squared_norm(edge);
    longest = (1 / std::sqrt(squared_length)) * edge;
  }
  return longest;
}

Spine spine_of(const std::vector<Vec2>& outline) {
  constexpr double kLong = 2;  // Times as long as wide.
  constexpr double kSpacing = 12;
  const PageBox box = bounds_of(outline);
  const Vec2 along = direction_of(outline);
  const Vec2 across = {-along.y, along.x};
  std::vector<Vec2> turned;
  for (const Vec2 p : outline) turned.push_back({dot(p, along), dot(p, across)});
  const PageBox own = bounds_of(turned);
  if (own.width() < kLong * own.height()) {
    return {{middle_of(box)}, 0.5 * std::max(box.width(), box.height())};
  }
  const Vec2 c = middle_of(own);
  const Vec2 middle = c.x * along + c.y * across;
  const double reach = 0.5 * (own.width() - own.height());
  const auto count = static_cast<int>(std::min(100.0, std::ceil(reach / kSpacing)));
  Spine spine{{middle}, 0.5 * own.height(), std::abs(along.x * along.y) < 1e-6};
  for (int k = 1; k <= count; ++k) {
    const Vec2 offset = (reach * k / count) * along;
    spine.points.push_back(middle + offset);
    spine.points.push_back(middle - offset);
  }
  return spine;
}

/// Boxes that cover a body. Those of a slanting wall follow it: one box around the whole would keep
/// labels away from half of the page.
std::vector<PageBox> boxes_of(const Spine& spine, const std::vector<Vec2>& outline) {
  if (spine.is_straight || spine.points.size() < 3) return {bounds_of(outline)};
  std::vector<PageBox> boxes;
  const double half = spine.half_width;
  // The points go outwards on both sides in turn; two before is the neighbour towards the middle.
  for (std::size_t i = 1; i < spine.points.size(); ++i) {
    PageBox box = bounds_of({spine.points[i], spine.points[i < 2 ? 0 : i - 2]});
    boxes.push_back({box.x0 - half, box.y0 - half, box.x1 + half, box.y1 + half});
  }
  return boxes;
}

}  // namespace

std::vector<Vec2> to_page(const Panel& panel, const std::vector<Vec2>& points_W) {
  std::vector<Vec2> points;
  points.reserve(points_W.size());
  for (const Vec2 p_W : points_W) points.push_back(panel.to_page(p_W));
  return points;
}

PageBox bounds_of(const std::vector<Vec2>& points) {
  constexpr double kFar = std::numeric_limits<double>::max();
  PageBox box{kFar, kFar, -kFar, -kFar};
  for (const Vec2 p : points) {
    box = {std::min(box.x0, p.x), std::min(box.y0, p.y), std::max(box.x1, p.x),
           std::max(box.y1, p.y)};
  }
  return box;
}

Vec2 middle_of(const PageBox& box) noexcept {
  return {0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)};
}

void draw_body(Pen& pen, const std::vector<Vec2>& outline, Kind kind, Rgb colour) {
  const PageBox box = bounds_of(outline);
  // A map of a building has bodies below the width of a line.
  if (std::max(box.width(), box.height()) < 2 * kLeastRadius) {
    pen.disc(middle_of(box), kLeastRadius);
    pen.fill(colour);
    return;
  }
  if (kind == Kind::kVirtualObstacle) {
    pen.path(outline, true);
    pen.fill(lighter(colour, 0.82));
    hatch(pen, outline, colour);
    pen.path(outline, true);
    pen.stroke(colour, 1.2);
    return;
  }
  pen.path(outline, true);
  const bool is_light = kind == Kind::kOther || kind == Kind::kRobotPart;
  pen.fill_keeping_path(is_light ? lighter(colour, 0.7) : colour);
  pen.stroke(colour, 0.5);
}

void draw_bodies(Stage& stage, bool landmarks) {
  for (const PictureBody& body : stage.picture.bodies) {
    if ((body.kind == Kind::kLandmark) != landmarks) continue;
    draw_body(stage.pen, to_page(stage.panel, body.outline_W), body.kind,
              rgb_of(body.colour, body.kind));
  }
}

void label_beside(Stage& stage, std::span<const Vec2> points, double clearance,
                  std::string_view text, const TextStyle& style) {
  if (text.empty()) return;
  const double width = stage.pen.text_width(text, style);
  const auto box = stage.labels.place(points, width + 2, style.size, clearance + 1);
  if (!box) return;
  const auto nearest_to = [&](Vec2 p) {
    return Vec2{std::clamp(p.x, box->x0, box->x1), std::clamp(p.y, box->y0, box->y1)};
  };
  const Vec2 from = *std::ranges::min_element(
      points, {}, [&](Vec2 p) { return squared_norm(nearest_to(p) - p); });
  const double reach = clearance + 4;
  // Too far to be understood without a line to what it names.
  if (squared_norm(nearest_to(from) - from) > reach * reach) {
    stage.pen.line(from, nearest_to(from));
    stage.pen.stroke(style.colour, 0.6, 0.9);
  }
  stage.pen.text({box->x0 + 1, box->y1 - 0.14 * style.size}, text, style);
}

void label_beside(Stage& stage, Vec2 point, double clearance, std::string_view text,
                  const TextStyle& style) {
  label_beside(stage, {&point, 1}, clearance, text, style);
}

void label_bodies(Stage& stage) {
  std::vector<std::pair<const PictureBody*, Spine>> labelled;
  for (const PictureBody& body : stage.picture.bodies) {
    const std::vector<Vec2> outline = to_page(stage.panel, body.outline_W);
    const Spine spine = spine_of(outline);
    // Parts of a robot do not block labels: names of sensors are placed on them.
    if (body.kind != Kind::kRobotPart) {
      for (const PageBox& box : boxes_of(spine, outline)) stage.labels.block(box);
    }
    if (body.label.empty()) continue;
    stage.labels.add_object(spine.points);
    labelled.emplace_back(&body, spine);
  }
  if (labelled.size() > kMostLabels) return;
  for (const auto& [body, spine] : labelled) {
    const bool is_virtual = body->kind == Kind::kVirtualObstacle;
    TextStyle style{.size = 8.5, .colour = kInk, .bold = !is_virtual, .halo = true};
    if (is_virtual) style.colour = rgb_of("#1f6f9f");
    label_beside(stage, spine.points, spine.half_width, body->label, style);
  }
}

}  // namespace rave::report
