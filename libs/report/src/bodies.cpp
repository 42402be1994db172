// SPDX-License-Identifier: Apache-2.0
// Bodies of the world, and labels beside what they name.
#include <algorithm>
#include <limits>

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

void label_beside(Stage& stage, Vec2 anchor, double clearance, std::string_view text,
                  const TextStyle& style) {
  if (text.empty() || !stage.panel.frame.contains(anchor)) return;
  const double width = stage.pen.text_width(text, style);
  const auto box = stage.labels.place(anchor, width + 2, style.size, clearance + 1);
  if (!box) return;
  const Vec2 nearest = {std::clamp(anchor.x, box->x0, box->x1),
                        std::clamp(anchor.y, box->y0, box->y1)};
  const double reach = clearance + 4;
  // Too far to be understood without a line to what it names.
  if (squared_norm(nearest - anchor) > reach * reach) {
    stage.pen.line(anchor, nearest);
    stage.pen.stroke(style.colour, 0.6, 0.9);
  }
  stage.pen.text({box->x0 + 1, box->y1 - 0.14 * style.size}, text, style);
}

void label_bodies(Stage& stage) {
  std::size_t labelled = 0;
  for (const PictureBody& body : stage.picture.bodies) {
    // Parts of a robot do not block labels: names of sensors are placed on them.
    if (body.kind != Kind::kRobotPart) {
      stage.labels.block(bounds_of(to_page(stage.panel, body.outline_W)));
    }
    if (body.label.empty()) continue;
    stage.labels.add_anchor(middle_of(bounds_of(to_page(stage.panel, body.outline_W))));
    ++labelled;
  }
  if (labelled > kMostLabels) return;
  for (const PictureBody& body : stage.picture.bodies) {
    const PageBox box = bounds_of(to_page(stage.panel, body.outline_W));
    const bool is_virtual = body.kind == Kind::kVirtualObstacle;
    TextStyle style{.size = 8.5, .colour = kInk, .bold = !is_virtual, .halo = true};
    if (is_virtual) style.colour = rgb_of("#1f6f9f");
    label_beside(stage, middle_of(box), 0.5 * std::max(box.width(), box.height()), body.label,
                 style);
  }
}

}  // namespace rave::report
