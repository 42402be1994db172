// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/report/picture.hpp"

namespace rave::report {

/// A rectangle of the page; x to the right, y **down**, page units; x0 <= x1, y0 <= y1.
struct PageBox {
  double x0 = 0;
  double y0 = 0;
  double x1 = 0;
  double y1 = 0;

  [[nodiscard]] double width() const noexcept { return x1 - x0; }
  [[nodiscard]] double height() const noexcept { return y1 - y0; }
  [[nodiscard]] bool contains(Vec2 p) const noexcept {
    return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1;
  }
  [[nodiscard]] bool overlaps(const PageBox& other) const noexcept {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

enum class PanelContent : std::uint8_t { kTracks, kInstant };

/// One view of the world on the page.
struct Panel {
  PanelContent content = PanelContent::kTracks;
  PageBox frame;  ///< Its place on the page.
  Vec2 centre_W;  ///< The world point in the centre of the frame.
  double units_per_m = 1;

  /// World to page coordinates. Multiply by the scale of a PNG to get pixels.
  [[nodiscard]] Vec2 to_page(Vec2 p_W) const noexcept {
    return {0.5 * (frame.x0 + frame.x1) + units_per_m * (p_W.x - centre_W.x),
            0.5 * (frame.y0 + frame.y1) - units_per_m * (p_W.y - centre_W.y)};
  }
};

/// The places of all parts of a picture.
struct Layout {
  double width = 0;
  double height = 0;
  std::vector<Panel> panels;  ///< One or two, with equal scale.
  PageBox legend;
  PageBox caption;
};

/// The layout of write_svg and write_png. Panels of tall worlds are side by side, those of wide
/// worlds one above the other; a very narrow world is shown with empty floor beside it. Errors:
/// those of write_svg.
[[nodiscard]] Result<Layout> lay_out(const Picture& picture);

/// The grid step in metres: the smallest of 1, 2 or 5 times a power of ten that is not below
/// `least_m` (> 0).
[[nodiscard]] double nice_step_m(double least_m) noexcept;

}  // namespace rave::report
