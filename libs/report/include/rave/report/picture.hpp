// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/report/palette.hpp"

// The picture of a run, as plain values. Everything is in the world frame W, metres, radians and
// seconds of the run; all text is UTF-8; `colour` is `#rrggbb`, or empty for the kind's own.
namespace rave::report {

/// A body that does not move: drawn to scale.
struct PictureBody {
  std::vector<Vec2> outline_W;  ///< Polygon, three corners or more, either sense.
  Kind kind = Kind::kOther;
  std::string label;  ///< A tube's id or an obstacle's name; empty for none.
  std::string colour;
};

struct TrackPoint {
  double t_s = 0;
  Pose2 X_WB;
};

/// A stretch of time in which a pose source was silent; t0_s <= t1_s.
struct PoseGap {
  double t0_s = 0;
  double t1_s = 0;
};

/// Where one robot was over time.
struct PictureTrack {
  std::string label;
  Kind kind = Kind::kSimulatedRobot;
  std::string colour;
  std::vector<TrackPoint> points;       ///< Times do not fall; may be empty.
  std::vector<PoseGap> gaps;            ///< Drawn dashed.
  bool odometry_only = false;           ///< Integrated commands beside the captured track: dashed.
  std::optional<double> pose_lost_t_s;  ///< Poses end here although the run goes on.
};

/// A robot at the frozen instant.
struct PictureRobot {
  std::vector<Vec2> outline_W;
  Pose2 X_WB;  ///< Where the heading mark starts and points.
  Kind kind = Kind::kSimulatedRobot;
  std::string label;
  std::string colour;
};

/// One laser ray at the frozen instant. Neighbours in the list with the same `from_W` are one fan.
struct PictureHit {
  Vec2 from_W;
  Vec2 to_W;                 ///< Where it ended; at maximum range if it met nothing.
  std::optional<Kind> kind;  ///< What it met; none: no return (shapes the fan, no dot).
};

/// A real camera's sighting at the frozen instant.
struct PictureSighting {
  Vec2 from_W;                 ///< The robot.
  Vec2 to_W;                   ///< Where range and bearing put the thing that was seen.
  std::optional<Vec2> tube_W;  ///< Where that thing is; none if the code is unknown.
  std::string label;
  std::string colour;
};

/// Everything that one moment of the run adds.
struct PictureInstant {
  double t_s = 0;
  std::string heading;         ///< Of its panel; empty: what the sensors see at `t_s`.
  bool show_all_rays = false;  ///< The panel is large enough for all rays, not just the bodies.
  std::vector<PictureRobot> robots;
  std::vector<PictureHit> hits;
  std::vector<PictureSighting> sightings;
};

/// A whole picture. With both tracks and an instant it has two panels of the same scale: (a) the
/// tracks, (b) the instant; with one of them, one panel.
struct Picture {
  std::string title;
  std::string subtitle;
  std::vector<std::string> caption;  ///< Lines below the legend; long ones are wrapped.
  std::vector<PictureBody> bodies;
  std::vector<PictureTrack> tracks;
  double tick_s = 10;  ///< Time between the ticks along a track, > 0; a time label each six.
  std::optional<PictureInstant> instant;
};

/// Draws the picture as SVG (text as outlines, so that it looks the same everywhere; the words are
/// in its `title` and `desc`) or as PNG with `scale` pixels per page unit (0.1 to 8; a page is 800
/// units wide). Both come from one drawing routine; equal input gives equal bytes. The file
/// appears whole or not at all. Errors: kInvalidArgument names the first value that is not finite,
/// out of order, no colour or no UTF-8; kNotFound if the folder is missing; kIo.
[[nodiscard]] Status write_svg(const Picture& picture, const std::filesystem::path& path);
[[nodiscard]] Status write_png(const Picture& picture, const std::filesystem::path& path,
                               double scale = 2);

}  // namespace rave::report
