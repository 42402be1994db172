// SPDX-License-Identifier: Apache-2.0
// Drawing with cairo. One description gives SVG and PNG with the same geometry.
#include "pen.hpp"

#include <array>

#include "rave/base/text_width.hpp"

namespace rave::report {
namespace {

constexpr double kTau = 6.283185307179586;

double hex_byte(char high, char low) noexcept {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    return (c | 0x20) - 'a' + 10;
  };
  return (16 * digit(high) + digit(low)) / 255.0;
}

}  // namespace

Rgb rgb_of(std::string_view colour) noexcept {
  if (colour.size() != 7) return {};
  return {hex_byte(colour[1], colour[2]), hex_byte(colour[3], colour[4]),
          hex_byte(colour[5], colour[6])};
}

Rgb rgb_of(std::string_view colour, Kind kind) noexcept {
  return rgb_of(colour.empty() ? palette_for(kind).colour : colour);
}

Rgb lighter(Rgb colour, double amount) noexcept {
  return {colour.r + amount * (1 - colour.r), colour.g + amount * (1 - colour.g),
          colour.b + amount * (1 - colour.b)};
}

void Pen::path(const std::vector<Vec2>& points, bool closed) {
  cairo_new_path(cr_);
  for (const Vec2 p : points) cairo_line_to(cr_, p.x, p.y);
  if (closed) cairo_close_path(cr_);
}

// One path for all, since in an SVG each path is an element.
void Pen::polygons(const std::vector<Vec2>& corners, double scale,
                   const std::vector<Vec2>& places) {
  cairo_new_path(cr_);
  for (const Vec2 place : places) {
    cairo_new_sub_path(cr_);
    for (const Vec2 corner : corners) {
      const Vec2 p = place + scale * corner;
      cairo_line_to(cr_, p.x, p.y);
    }
    cairo_close_path(cr_);
  }
}

void Pen::disc(Vec2 centre, double radius) {
  cairo_new_path(cr_);
  cairo_arc(cr_, centre.x, centre.y, radius, 0, kTau);
  cairo_close_path(cr_);
}

void Pen::box(const PageBox& box) {
  cairo_new_path(cr_);
  cairo_rectangle(cr_, box.x0, box.y0, box.width(), box.height());
}

void Pen::line(Vec2 a, Vec2 b) {
  cairo_new_path(cr_);
  cairo_move_to(cr_, a.x, a.y);
  cairo_line_to(cr_, b.x, b.y);
}

void Pen::segments(const std::vector<Vec2>& ends) {
  cairo_new_path(cr_);
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    cairo_move_to(cr_, ends[i].x, ends[i].y);
    cairo_line_to(cr_, ends[i + 1].x, ends[i + 1].y);
  }
}

void Pen::fill(Rgb rgb, double alpha) {
  colour(rgb, alpha);
  cairo_fill(cr_);
}

void Pen::fill_keeping_path(Rgb rgb, double alpha) {
  colour(rgb, alpha);
  cairo_fill_preserve(cr_);
}

void Pen::stroke(Rgb rgb, double width, double alpha) {
  stroke_keeping_path(rgb, width, alpha);
  cairo_new_path(cr_);
}

void Pen::stroke_keeping_path(Rgb rgb, double width, double alpha) {
  colour(rgb, alpha);
  cairo_set_line_width(cr_, width);
  cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke_preserve(cr_);
}

void Pen::stroke_dashed(Rgb rgb, double width, double on, double off, double alpha) {
  const std::array<double, 2> dashes = {on, off};
  cairo_set_dash(cr_, dashes.data(), 2, 0);
  stroke(rgb, width, alpha);
  cairo_set_dash(cr_, nullptr, 0, 0);
}

void Pen::clip(const PageBox& area) {
  box(area);
  clip_to_path();
}

void Pen::clip_to_path() {
  cairo_save(cr_);
  cairo_clip(cr_);
}

void Pen::set_font(const TextStyle& style) {
  cairo_select_font_face(cr_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr_, style.size);
  // Without hinting, so that text has equal width in an SVG and in a PNG of any scale.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(cr_, options);
  cairo_font_options_destroy(options);
}

double Pen::text_width(std::string_view text, const TextStyle& style) {
  set_font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(cr_, std::string(text).c_str(), &extents);
  return extents.x_advance;
}

void Pen::text(Vec2 at, std::string_view text, const TextStyle& style) {
  const double left = at.x - style.align * text_width(text, style);
  const std::string terminated(text);
  cairo_new_path(cr_);
  cairo_move_to(cr_, left, at.y);
  // A white border around the letters keeps them legible on lines and hatching.
  if (style.halo) {
    cairo_text_path(cr_, terminated.c_str());
    stroke(kWhite, 0.3 * style.size, 0.9);
    cairo_move_to(cr_, left, at.y);
  }
  colour(style.colour);
  cairo_show_text(cr_, terminated.c_str());
  cairo_new_path(cr_);
}

std::string Pen::fit(std::string_view text, double width, const TextStyle& style) {
  if (text_width(text, style) <= width) return std::string(text);
  std::size_t columns = columns_of(text);
  std::string shorter(text);
  // Character by character, because letters have different widths.
  while (columns > 1 && text_width(shorter, style) > width) {
    shorter = clip_to_columns(text, --columns);
  }
  return shorter;
}

std::vector<std::string> Pen::wrap(std::string_view text, double width, const TextStyle& style) {
  std::vector<std::string> lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(space == std::string_view::npos ? text.size() : space + 1);
    const std::string longer = line.empty() ? std::string(word) : line + " " + std::string(word);
    if (!line.empty() && text_width(longer, style) > width) {
      lines.push_back(line);
      line = word;
    } else {
      line = longer;
    }
  }
  if (!line.empty()) lines.push_back(line);
  // A single word may still be too long.
  for (std::string& each : lines) each = fit(each, width, style);
  return lines;
}

MeasuringPen::MeasuringPen()
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1)),
      context_(cairo_create(surface_)),
      pen_(context_) {}

MeasuringPen::~MeasuringPen() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

}  // namespace rave::report
