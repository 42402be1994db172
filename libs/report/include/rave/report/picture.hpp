// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/report/palette.hpp"

// The picture of a run, as plain values. All positions are in the world frame W in metres, angles
// in radians, times in seconds of the run; texts are UTF-8; `colour` is `#rrggbb`, or empty for the
// kind's colour.
namespace rave::report {

/// A static body, drawn to scale.
struct PictureBody {
  /// Polygon with at least three corners, clockwise or counter-clockwise.
  std::vector<Vec2> outline_W;
  Kind kind = Kind::kOther;
  std::string label;  ///< Barcode of a tube or name of an obstacle; empty for none.
  std::string colour;
};

struct TrackPoint {
  double t_s = 0;
  Pose2 X_WB;
};

/// An interval in which a pose source was silent; t0_s <= t1_s.
struct PoseGap {
  double t0_s = 0;
  double t1_s = 0;
};

/// The poses of one robot over time.
struct PictureTrack {
  std::string label;
  Kind kind = Kind::kSimulatedRobot;
  std::string colour;
  std::vector<TrackPoint> points;  ///< In order of time; may be empty.
  std::vector<PoseGap> gaps;       ///< Drawn dashed.
  /// Integrated odometry shown beside the captured track; drawn dashed.
  bool odometry_only = false;
  std::optional<double> pose_lost_t_s;  ///< Set if the poses end here before the run does.
};

/// A robot at the time of the picture.
struct PictureRobot {
  std::vector<Vec2> outline_W;
  Pose2 X_WB;  ///< Position and direction of the heading mark.
  Kind kind = Kind::kSimulatedRobot;
  std::string label;
  std::string colour;
};

/// One laser ray at the time of the picture. Consecutive entries with the same `from_W` are one
/// fan.
struct PictureHit {
  Vec2 from_W;
  Vec2 to_W;                 ///< Its end; at maximum range if there was no return.
  std::optional<Kind> kind;  ///< The kind it hit; empty: no return (outlines the fan, no dot).
};

/// A sighting by a real camera at the time of the picture.
struct PictureSighting {
  Vec2 from_W;                 ///< Position of the robot.
  Vec2 to_W;                   ///< Position of the landmark according to range and bearing.
  std::optional<Vec2> tube_W;  ///< True position of the landmark; empty if the code is unknown.
  std::string label;
  std::string colour;
};

/// The state of the run at one time.
struct PictureInstant {
  double t_s = 0;
  std::string heading;         ///< Heading of its panel; empty: a default that names `t_s`.
  bool show_all_rays = false;  ///< Scale the panel so that all rays fit, not just the bodies.
  std::vector<PictureRobot> robots;
  std::vector<PictureHit> hits;
  std::vector<PictureSighting> sightings;
};

/// A picture. With both tracks and an instant it has two panels of equal scale: (a) the tracks, (b)
/// the instant; otherwise one panel.
struct Picture {
  std::string title;
  std::string subtitle;
  std::vector<std::string> caption;  ///< Lines below the legend; long ones are wrapped.
  std::vector<PictureBody> bodies;
  std::vector<PictureTrack> tracks;
  double tick_s = 10;  ///< Time between the ticks along a track, > 0; every sixth has a time label.
  std::optional<PictureInstant> instant;
};

/// Draws the picture as SVG (text as outlines, so that it does not depend on fonts; `title` and
/// `desc` contain the words) or as PNG with `scale` pixels per page unit (0.1 to 8; a page is 800
/// units wide). Both use the same drawing routine; equal input gives equal bytes. The file is
/// written atomically. Errors: kInvalidArgument names the first value that is not finite, out of
/// order, not a colour or not UTF-8; kNotFound if the folder does not exist; kIo.
[[nodiscard]] Status write_svg(const Picture& picture, const std::filesystem::path& path);
[[nodiscard]] Status write_png(const Picture& picture, const std::filesystem::path& path,
                               double scale = 2);

}  // namespace rave::report
