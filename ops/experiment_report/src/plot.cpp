// SPDX-License-Identifier: Apache-2.0
#include "plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "rave/base/markup.hpp"

namespace rave::experiment {

Axis::Axis(double low, double high, double from, double to, std::size_t ticks)
    : low_(low), high_(high), from_(from), to_(to) {
  if (!(high_ > low_)) {
    const double around = std::max(std::abs(low_) * 0.1, 0.5);
    low_ -= around;
    high_ += around;
  }
  const double rough = (high_ - low_) / static_cast<double>(std::max<std::size_t>(ticks, 1));
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) {
      step = factor * power;
      break;
    }
  }
  low_ = std::floor(low_ / step + 1e-9) * step;
  high_ = std::ceil(high_ / step - 1e-9) * step;
  const auto count = static_cast<int>(std::lround((high_ - low_) / step));
  for (int i = 0; i <= count; ++i) ticks_.push_back(low_ + i * step);
}

double Axis::at(double value) const {
  const double share = std::clamp((value - low_) / (high_ - low_), 0.0, 1.0);
  return from_ + share * (to_ - from_);
}

std::string colour_class(std::size_t i) { return fmt::format("c{}", i % 6); }

Plot::Plot(double width, double height, std::string_view title) {
  svg_ = fmt::format(
      "<svg viewBox=\"0 0 {:.0f} {:.0f}\" style=\"max-width:{:.0f}px\" role=\"img\" "
      "aria-label=\"{}\">\n",
      width, height, width, escaped_markup(title));
}

void Plot::line(double x1, double y1, double x2, double y2, std::string_view css) {
  fmt::format_to(std::back_inserter(svg_),
                 "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n",
                 x1, y1, x2, y2, css);
}

void Plot::dot(double x, double y, double radius, std::string_view css, std::string_view title) {
  fmt::format_to(std::back_inserter(svg_),
                 "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" class=\"{}\">", x, y, radius,
                 css);
  if (!title.empty()) svg_ += "<title>" + escaped_markup(title) + "</title>";
  svg_ += "</circle>\n";
}

void Plot::box(double x, double y, double width, double height, std::string_view attributes) {
  fmt::format_to(std::back_inserter(svg_),
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", x, y,
                 width, height, attributes);
}

void Plot::text(double x, double y, std::string_view anchor, std::string_view css,
                std::string_view text) {
  fmt::format_to(std::back_inserter(svg_),
                 "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"{}\">{}</text>\n", x,
                 y, anchor, css, escaped_markup(text));
}

void Plot::upright(double x, double y, std::string_view text) {
  fmt::format_to(std::back_inserter(svg_),
                 "<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" text-anchor=\"middle\" "
                 "class=\"axis\">{}</text>\n",
                 x, y, escaped_markup(text));
}

void Plot::path(std::string_view d, std::string_view css) {
  fmt::format_to(std::back_inserter(svg_), "<path d=\"{}\" class=\"{}\"/>\n", d, css);
}

std::string Plot::svg() && { return std::move(svg_) + "</svg>\n"; }

}  // namespace rave::experiment
