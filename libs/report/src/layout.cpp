// SPDX-License-Identifier: Apache-2.0
// Sizes of a page from its content, in units of the page; panels have the same scale for x and y.
#include "rave/report/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_picture.hpp"
#include "legend.hpp"
#include "page.hpp"

namespace rave::report {
namespace {

constexpr double kPageWidth = 800;
constexpr double kLeft = 46;
constexpr double kRight = 18;
constexpr double kBetween = 20;
constexpr double kBelowPanel = 46;  ///< Axis numbers, axis title, scale bar.
constexpr double kHeading = 22;     ///< Above a panel.
constexpr double kThinnest = 0.16;  ///< Least height of a panel relative to its width.
constexpr double kSideBySideFrom = 0.75;

/// Height relative to width of the tallest panel, alone or beside another.
constexpr double kTallestAlone = 1.25;
constexpr double kTallestBeside = 2.3;

/// The smallest rectangle of the world that holds everything of the picture.
class Extent {
 public:
  void add(Vec2 p_W) noexcept {
    low_ = {std::min(low_.x, p_W.x), std::min(low_.y, p_W.y)};
    high_ = {std::max(high_.x, p_W.x), std::max(high_.y, p_W.y)};
  }
  void add(const std::vector<Vec2>& points_W) noexcept {
    for (const Vec2 p_W : points_W) add(p_W);
  }
  /// Adds a margin; without content, a metre around the origin.
  void close() noexcept {
    if (low_.x > high_.x) low_ = high_ = {};
    const Vec2 size = high_ - low_;
    const double margin_m = std::max(0.035 * std::max(size.x, size.y), 0.2);
    low_ = low_ - Vec2{margin_m, margin_m};
    high_ = high_ + Vec2{margin_m, margin_m};
  }
  [[nodiscard]] Vec2 size() const noexcept { return high_ - low_; }
  [[nodiscard]] Vec2 centre() const noexcept { return 0.5 * (low_ + high_); }

 private:
  static constexpr double kFar = std::numeric_limits<double>::max();
  Vec2 low_ = {kFar, kFar};
  Vec2 high_ = {-kFar, -kFar};
};

/// Rays and sightings are not included: an outlier must not shrink the rest; it is clipped at the
/// frame.
Extent extent_of(const Picture& picture) {
  Extent extent;
  for (const PictureBody& body : picture.bodies) extent.add(body.outline_W);
  for (const PictureTrack& track : picture.tracks) {
    for (const TrackPoint& point : track.points) extent.add(point.X_WB.position());
  }
  if (picture.instant) {
    for (const PictureRobot& robot : picture.instant->robots) extent.add(robot.outline_W);
    for (const PictureHit& hit : picture.instant->hits) {
      if (picture.instant->show_all_rays) extent.add(hit.to_W);
    }
  }
  extent.close();
  return extent;
}

bool has_tracks(const Picture& picture) {
  return std::any_of(picture.tracks.begin(), picture.tracks.end(),
                     [](const PictureTrack& track) { return !track.points.empty(); });
}

/// Adds the panels and returns the page height below them.
double add_panels(const Picture& picture, double top, Layout& layout) {
  const Extent extent = extent_of(picture);
  const double aspect = extent.size().y / extent.size().x;
  std::vector<PanelContent> contents;
  if (has_tracks(picture) || !picture.instant) contents.push_back(PanelContent::kTracks);
  if (picture.instant) contents.push_back(PanelContent::kInstant);

  // Wide worlds fit above each other, tall ones beside each other.
  const bool beside = contents.size() == 2 && aspect >= kSideBySideFrom;
  const double whole = kPageWidth - kLeft - kRight;
  const double width = beside ? 0.5 * (whole - kBetween) : whole;
  const double height =
      width * std::clamp(aspect, kThinnest, beside ? kTallestBeside : kTallestAlone);
  double x = kLeft;
  double y = top + kHeading;
  for (const PanelContent content : contents) {
    const double units_per_m = std::min(width / extent.size().x, height / extent.size().y);
    layout.panels.push_back({content, {x, y, x + width, y + height}, extent.centre(), units_per_m});
    if (beside) {
      x += width + kBetween;
    } else {
      y += height + kBelowPanel + kHeading;
    }
  }
  return layout.panels.back().frame.y1 + kBelowPanel;
}

}  // namespace

Result<Layout> lay_out(const Picture& picture) {
  RAVE_TRY(check_picture(picture));
  // Text is measured before there is a page: its height decides where the panels begin.
  MeasuringPen measure;
  Layout layout;
  layout.width = kPageWidth;
  const double text_width = kPageWidth - kLeft - kRight;
  const double head = height_of_head(measure.pen(), picture, text_width);
  double y = add_panels(picture, 14 + head, layout);
  layout.legend = {kLeft, y, kPageWidth - kRight, y + height_of(legend_of(picture))};
  y = layout.legend.y1 + (layout.legend.height() > 0 ? 10 : 0);
  const double caption = height_of_caption(measure.pen(), picture, text_width);
  layout.caption = {kLeft, y, kPageWidth - kRight, y + caption};
  // An integer, so that the number of pixels is too at the usual scales.
  layout.height = std::ceil(layout.caption.y1 + 10);
  return layout;
}

}  // namespace rave::report
