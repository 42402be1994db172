// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "label_placer.hpp"
#include "pen.hpp"

namespace rave::report {

/// With more tracks or labels the picture omits them, because they would be illegible.
inline constexpr std::size_t kMostTracksWithTicks = 60;
inline constexpr std::size_t kMostLabels = 60;
inline constexpr std::size_t kMostFans = 60;
inline constexpr std::size_t kMostNamedTracks = 8;

/// How strongly labels avoid covering faint lines, and the lines and marks that matter.
inline constexpr int kFaintWeight = 1;
inline constexpr int kStrongWeight = 4;

/// The common state of drawing one panel.
struct Stage {
  const Picture& picture;
  const Panel& panel;
  Pen& pen;
  LabelPlacer& labels;
};

/// Grid and background (drawn first), and frame, axes and heading (drawn after the content).
void draw_grid(Stage& stage);
void draw_frame(Stage& stage, std::string_view heading, bool with_y_labels);
/// Static bodies, either the landmarks (small: drawn above lines) or the others, and the labels of
/// all.
void draw_bodies(Stage& stage, bool landmarks);
void label_bodies(Stage& stage);
/// Tracks with ticks, gaps and end marks, and their labels.
void draw_tracks(Stage& stage);
void label_tracks(Stage& stage);
/// The end of each track before a time, one tick interval long.
void draw_trails(Stage& stage, double t_s);
/// The time of the picture: fans, sightings, robots, hits, and the robots' labels.
void draw_instant(Stage& stage);
void label_instant(Stage& stage);

[[nodiscard]] std::vector<Vec2> to_page(const Panel& panel, const std::vector<Vec2>& points_W);
[[nodiscard]] PageBox bounds_of(const std::vector<Vec2>& points);
[[nodiscard]] Vec2 middle_of(const PageBox& box) noexcept;

/// Draws a label beside one of the points of an object, the best first, with a thin leader if it is
/// farther away; nothing if there is no room or no point is on the panel.
void label_beside(Stage& stage, std::span<const Vec2> points, double clearance,
                  std::string_view text, const TextStyle& style);
void label_beside(Stage& stage, Vec2 point, double clearance, std::string_view text,
                  const TextStyle& style);

/// Small marks, shared with the legend.
void draw_body(Pen& pen, const std::vector<Vec2>& outline, Kind kind, Rgb colour);
void draw_robot(Pen& pen, const std::vector<Vec2>& outline, Vec2 centre, Vec2 nose, Kind kind,
                Rgb colour);
/// The marks of hits on one kind of body; each kind has a shape and a colour.
void draw_hits(Pen& pen, const std::vector<Vec2>& places, Kind kind);
void draw_sighting(Pen& pen, Vec2 from, Vec2 to, const std::optional<Vec2>& tube, Rgb colour);
void draw_lost_mark(Pen& pen, Vec2 at, Rgb colour);
void draw_gap_mark(Pen& pen, Vec2 at, Rgb colour);

/// How the tracks of a kind are drawn.
struct TrackLook {
  double width;
  double alpha;
  double tick;     ///< Half the length of a tick.
  bool is_strong;  ///< With outline, time labels, start and end marks.
};
[[nodiscard]] TrackLook look_of(const PictureTrack& track) noexcept;
void stroke_track(Pen& pen, const PictureTrack& track, const std::vector<Vec2>& points,
                  bool in_gap);

}  // namespace rave::report
