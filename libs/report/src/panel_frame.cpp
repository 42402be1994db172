// SPDX-License-Identifier: Apache-2.0
// Grid, axes and scale of a panel.
#include <cmath>

#include "stage.hpp"

namespace rave::report {
namespace {

constexpr double kLeastLabelSpacing = 30;

/// Calls `draw(value_m)` for the multiples of `step_m` in [low_m, high_m].
template <class Draw>
void for_multiples(double step_m, double low_m, double high_m, Draw draw) {
  const double first = std::ceil(low_m / step_m);
  // Multiplied and not added up, so that rounding does not grow along the axis.
  for (double k = first; k * step_m <= high_m; k += 1) draw(k * step_m);
}

struct Window {
  Vec2 low_W;
  Vec2 high_W;
};

Window window_of(const Panel& panel) {
  const Vec2 half = {0.5 * panel.frame.width() / panel.units_per_m,
                     0.5 * panel.frame.height() / panel.units_per_m};
  return {panel.centre_W - half, panel.centre_W + half};
}

std::string number(double value_m) {
  // Adding 0.0 turns -0 into 0; a typographic minus is as wide as a plus.
  std::string text = fmt::format("{:g}", value_m + 0.0);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

void draw_scale_bar(Stage& stage, double step_m) {
  const PageBox& frame = stage.panel.frame;
  const double length = step_m * stage.panel.units_per_m;
  const TextStyle style{.size = 8.5, .colour = kSoftInk, .align = 1};
  const double y = frame.y1 + 24;
  stage.pen.text({frame.x1 - length - 5, y + 3}, number(step_m) + " m", style);
  stage.pen.line({frame.x1 - length, y}, {frame.x1, y});
  stage.pen.stroke(kInk, 1.6);
  for (const double x : {frame.x1 - length, frame.x1}) {
    stage.pen.line({x, y - 3}, {x, y + 3});
    stage.pen.stroke(kInk, 1.0);
  }
}

}  // namespace

// 1, 2 or 5 times a power of ten: numbers that people read without effort.
double nice_step_m(double least_m) noexcept {
  double decade = 1;
  while (decade > least_m) decade /= 10;
  while (decade * 10 <= least_m) decade *= 10;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least_m) return factor * decade;
  }
  return 10 * decade;
}

void draw_grid(Stage& stage) {
  const Panel& panel = stage.panel;
  const Window window = window_of(panel);
  const double step_m = nice_step_m(14 / panel.units_per_m);
  for_multiples(step_m, window.low_W.x, window.high_W.x, [&](double x) {
    stage.pen.line(panel.to_page({x, window.low_W.y}), panel.to_page({x, window.high_W.y}));
    stage.pen.stroke(kGridInk, 0.6);
  });
  for_multiples(step_m, window.low_W.y, window.high_W.y, [&](double y) {
    stage.pen.line(panel.to_page({window.low_W.x, y}), panel.to_page({window.high_W.x, y}));
    stage.pen.stroke(kGridInk, 0.6);
  });
}

void draw_frame(Stage& stage, std::string_view heading, bool with_y_labels) {
  const Panel& panel = stage.panel;
  const PageBox& frame = panel.frame;
  const Window window = window_of(panel);
  stage.pen.box(frame);
  stage.pen.stroke(kInk, 0.8);
  const TextStyle tick{.size = 8.5, .colour = kSoftInk, .align = 0.5};
  const double step_m = nice_step_m(kLeastLabelSpacing / panel.units_per_m);
  for_multiples(step_m, window.low_W.x, window.high_W.x, [&](double x) {
    const double at = panel.to_page({x, 0}).x;
    stage.pen.line({at, frame.y1}, {at, frame.y1 + 3});
    stage.pen.stroke(kInk, 0.8);
    stage.pen.text({at, frame.y1 + 13}, number(x), tick);
  });
  for_multiples(step_m, window.low_W.y, window.high_W.y, [&](double y) {
    const double at = panel.to_page({0, y}).y;
    stage.pen.line({frame.x0, at}, {frame.x0 - 3, at});
    stage.pen.stroke(kInk, 0.8);
    if (!with_y_labels) return;
    stage.pen.text({frame.x0 - 6, at + 3}, number(y),
                   {.size = 8.5, .colour = kSoftInk, .align = 1});
  });
  const TextStyle axis{.size = 9, .colour = kInk, .align = 0.5};
  stage.pen.text({middle_of(frame).x, frame.y1 + 27}, "x (m)", axis);
  if (with_y_labels) {
    cairo_t* cr = stage.pen.context();
    cairo_save(cr);
    cairo_translate(cr, frame.x0 - 28, middle_of(frame).y);
    cairo_rotate(cr, -1.5707963267948966);
    stage.pen.text({0, 0}, "y (m)", axis);
    cairo_restore(cr);
  }
  draw_scale_bar(stage, step_m);
  const TextStyle head{.size = 10.5, .colour = kInk, .bold = true};
  stage.pen.text({frame.x0, frame.y0 - 7}, stage.pen.fit(heading, frame.width(), head), head);
}

}  // namespace rave::report
