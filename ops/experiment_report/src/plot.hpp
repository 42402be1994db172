// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rave::experiment {

/// A range of values on a length of a picture, with round numbers at its ticks.
class Axis {
 public:
  /// From `low` to `high`, which may be equal, on `from` to `to` in units of the picture.
  Axis(double low, double high, double from, double to, std::size_t ticks = 5);

  /// Values beyond the ends are put at the end.
  [[nodiscard]] double at(double value) const;
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

 private:
  double low_;
  double high_;
  double from_;
  double to_;
  std::vector<double> ticks_;
};

/// The class of the colour of the i-th of several lines: `c0` to `c5`; see the style of the page.
[[nodiscard]] std::string colour_class(std::size_t i);

/// An SVG picture: elements in the order in which they are drawn, and its text as text.
class Plot {
 public:
  /// `title`: what a screen reader says.
  Plot(double width, double height, std::string_view title);

  void line(double x1, double y1, double x2, double y2, std::string_view css);
  void dot(double x, double y, double radius, std::string_view css, std::string_view title = {});
  void box(double x, double y, double width, double height, std::string_view attributes);
  /// `anchor`: start, middle or end.
  void text(double x, double y, std::string_view anchor, std::string_view css,
            std::string_view text);
  /// An upright text, read from below.
  void upright(double x, double y, std::string_view text);
  /// A path of SVG.
  void path(std::string_view d, std::string_view css);

  [[nodiscard]] std::string svg() &&;

 private:
  std::string svg_;
};

}  // namespace rave::experiment
