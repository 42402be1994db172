// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pen.hpp"

namespace rave::report {

/// Title and subtitle, and the lines below the legend: their heights and drawing.
[[nodiscard]] double height_of_head(Pen& pen, const Picture& picture, double width);
[[nodiscard]] double height_of_caption(Pen& pen, const Picture& picture, double width);

/// The whole page, on white.
void draw_page(Pen& pen, const Picture& picture, const Layout& layout);

}  // namespace rave::report
