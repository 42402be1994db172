// SPDX-License-Identifier: Apache-2.0
// A page: head, panels, legend, caption.
#include "page.hpp"

#include "legend.hpp"
#include "stage.hpp"

namespace rave::report {
namespace {

constexpr TextStyle kTitle{.size = 16, .colour = kInk, .bold = true};
constexpr TextStyle kSubtitle{.size = 10, .colour = kSoftInk};
constexpr TextStyle kCaption{.size = 8.5, .colour = kSoftInk};
constexpr double kTitleLine = 20;
constexpr double kSubtitleLine = 14;
constexpr double kCaptionLine = 12;

struct Line {
  std::string text;
  TextStyle style;
  double height;
};

std::vector<Line> head_of(Pen& pen, const Picture& picture, double width) {
  std::vector<Line> lines;
  for (std::string& text : pen.wrap(picture.title, width, kTitle)) {
    lines.push_back({std::move(text), kTitle, kTitleLine});
  }
  for (std::string& text : pen.wrap(picture.subtitle, width, kSubtitle)) {
    lines.push_back({std::move(text), kSubtitle, kSubtitleLine});
  }
  return lines;
}

std::vector<Line> caption_of(Pen& pen, const Picture& picture, double width) {
  std::vector<Line> lines;
  for (const std::string& paragraph : picture.caption) {
    for (std::string& text : pen.wrap(paragraph, width, kCaption)) {
      lines.push_back({std::move(text), kCaption, kCaptionLine});
    }
  }
  return lines;
}

double height_of(const std::vector<Line>& lines) {
  double height = 0;
  for (const Line& line : lines) height += line.height;
  return height;
}

void draw_lines(Pen& pen, const std::vector<Line>& lines, double x, double y) {
  for (const Line& line : lines) {
    y += line.height;
    pen.text({x, y - 0.25 * line.height}, line.text, line.style);
  }
}

void draw_panel(Pen& pen, const Picture& picture, const Panel& panel, char letter, bool beside) {
  LabelPlacer labels(panel.frame);
  Stage stage{picture, panel, pen, labels};
  const bool is_instant = panel.content == PanelContent::kInstant;
  // Bodies, tracks and rays may leave the panel; labels may not, as the placer knows the frame.
  pen.clip(panel.frame);
  draw_grid(stage);
  if (is_instant) {
    draw_instant(stage);
    label_bodies(stage);
    label_instant(stage);
  } else {
    draw_bodies(stage, false);
    draw_tracks(stage);
    draw_bodies(stage, true);
    label_bodies(stage);
    label_tracks(stage);
  }
  pen.unclip();
  std::string heading =
      is_instant && !picture.instant->heading.empty() ? picture.instant->heading
      : is_instant ? fmt::format("What the sensors see at t = {:g} s", picture.instant->t_s)
                   : "Where the robots drove";
  if (letter != 0) heading = fmt::format("({})  {}", letter, heading);
  // Last and not clipped: axis numbers are outside of the frame.
  draw_frame(stage, heading, !beside);
}

}  // namespace

double height_of_head(Pen& pen, const Picture& picture, double width) {
  return height_of(head_of(pen, picture, width));
}

double height_of_caption(Pen& pen, const Picture& picture, double width) {
  return height_of(caption_of(pen, picture, width));
}

void draw_page(Pen& pen, const Picture& picture, const Layout& layout) {
  pen.box({0, 0, layout.width, layout.height});
  pen.fill(kWhite);
  const double left = layout.legend.x0;
  draw_lines(pen, head_of(pen, picture, layout.legend.width()), left, 14);
  const bool is_pair = layout.panels.size() == 2;
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    const bool beside = i > 0 && layout.panels[i].frame.x0 > layout.panels[0].frame.x0;
    const char letter = is_pair ? static_cast<char>('a' + static_cast<char>(i)) : '\0';
    draw_panel(pen, picture, layout.panels[i], letter, beside);
  }
  draw_legend(pen, legend_of(picture), layout.legend);
  draw_lines(pen, caption_of(pen, picture, layout.caption.width()), left, layout.caption.y0);
}

}  // namespace rave::report
