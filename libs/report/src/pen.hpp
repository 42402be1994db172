// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "rave/math/pose.hpp"
#include "rave/report/layout.hpp"

namespace rave::report {

struct Rgb {
  double r = 0;
  double g = 0;
  double b = 0;
};

inline constexpr Rgb kWhite = {1, 1, 1};
inline constexpr Rgb kInk = {0.13, 0.13, 0.15};        ///< Text and frames.
inline constexpr Rgb kSoftInk = {0.38, 0.39, 0.42};    ///< Subordinate text.
inline constexpr Rgb kGridInk = {0.90, 0.905, 0.915};  ///< Grid lines.

/// Parses `#rrggbb`, which must be checked before; anything else gives black.
[[nodiscard]] Rgb rgb_of(std::string_view colour) noexcept;
/// The given colour, or the kind's colour if empty.
[[nodiscard]] Rgb rgb_of(std::string_view colour, Kind kind) noexcept;
/// A mixture of the colour (0) and white (1).
[[nodiscard]] Rgb lighter(Rgb colour, double amount) noexcept;

struct TextStyle {
  double size = 9;
  Rgb colour = kInk;
  bool bold = false;
  bool halo = false;  ///< A white outline, so that it is legible on top of lines.
  double align = 0;   ///< 0: starts at the point, 0.5: centred on it, 1: ends at it.
};

/// Draws on a cairo context that it does not own. Page units, y down.
class Pen {
 public:
  explicit Pen(cairo_t* context) noexcept : cr_(context) {}

  [[nodiscard]] cairo_t* context() const noexcept { return cr_; }

  void colour(Rgb colour, double alpha = 1) {
    cairo_set_source_rgba(cr_, colour.r, colour.g, colour.b, alpha);
  }
  void path(const std::vector<Vec2>& points, bool closed);
  /// The same polygon, scaled by `scale`, at each place, as one path.
  void polygons(const std::vector<Vec2>& corners, double scale, const std::vector<Vec2>& places);
  void disc(Vec2 centre, double radius);
  void box(const PageBox& box);
  void line(Vec2 a, Vec2 b);
  /// A line between the first two points, the next two, and so on, as one path.
  void segments(const std::vector<Vec2>& ends);
  void fill(Rgb colour, double alpha = 1);
  void fill_keeping_path(Rgb colour, double alpha = 1);
  void stroke(Rgb colour, double width, double alpha = 1);
  void stroke_keeping_path(Rgb colour, double width, double alpha = 1);
  /// Strokes with dashes of `on` and gaps of `off`.
  void stroke_dashed(Rgb colour, double width, double on, double off, double alpha = 1);
  /// Clips everything up to `unclip` to the box, or to the current path.
  void clip(const PageBox& box);
  void clip_to_path();
  void unclip() { cairo_restore(cr_); }

  [[nodiscard]] double text_width(std::string_view text, const TextStyle& style);
  /// `at` is on the baseline.
  void text(Vec2 at, std::string_view text, const TextStyle& style);
  /// The text, shortened with an ellipsis to `width` if necessary.
  [[nodiscard]] std::string fit(std::string_view text, double width, const TextStyle& style);
  /// The text, wrapped at spaces into lines of at most `width`.
  [[nodiscard]] std::vector<std::string> wrap(std::string_view text, double width,
                                              const TextStyle& style);

 private:
  void set_font(const TextStyle& style);

  cairo_t* cr_;
};

/// A pen without a surface, to measure text before the page has a size.
class MeasuringPen {
 public:
  MeasuringPen();
  ~MeasuringPen();
  MeasuringPen(const MeasuringPen&) = delete;
  MeasuringPen& operator=(const MeasuringPen&) = delete;
  [[nodiscard]] Pen& pen() noexcept { return pen_; }

 private:
  cairo_surface_t* surface_;
  cairo_t* context_;
  Pen pen_;
};

}  // namespace rave::report
