// SPDX-License-Identifier: Apache-2.0
// Tracks of robots: lines, ticks of time, gaps, ends. Points too close to be seen are left out, so
// that a long run stays a small file.
#include <algorithm>
#include <cmath>

#include "stage.hpp"

namespace rave::report {
namespace {

constexpr double kTicksPerLabel = 6;
/// The direction of a tick is averaged over this time before and after it, because poses are noisy.
constexpr double kDirectionSpan_s = 1.5;
/// A shorter gap gets a ring, because its dashes would be invisible.
constexpr double kShortGap = 7;

double length_of(Vec2 v) { return std::sqrt(squared_norm(v)); }

bool is_in_gap(const PictureTrack& track, double t0_s, double t1_s) {
  return std::any_of(track.gaps.begin(), track.gaps.end(),
                     [&](const PoseGap& gap) { return gap.t0_s < t1_s && gap.t1_s > t0_s; });
}

/// The track's position on the page at a time within its duration.
Vec2 page_at(const PictureTrack& track, const Panel& panel, double t_s) {
  const auto& points = track.points;
  const auto after =
      std::lower_bound(points.begin(), points.end(), t_s,
                       [](const TrackPoint& point, double time_s) { return point.t_s < time_s; });
  if (after == points.begin()) return panel.to_page(points.front().X_WB.position());
  if (after == points.end()) return panel.to_page(points.back().X_WB.position());
  const TrackPoint& a = *(after - 1);
  const double span_s = after->t_s - a.t_s;
  const double part = span_s > 0 ? (t_s - a.t_s) / span_s : 0;
  const Vec2 from = panel.to_page(a.X_WB.position());
  return from + part * (panel.to_page(after->X_WB.position()) - from);
}

/// The unit direction of travel on the page at a time; {0, 0} for a robot that stands.
Vec2 direction_at(const PictureTrack& track, const Panel& panel, double t_s) {
  const Vec2 along =
      page_at(track, panel, t_s + kDirectionSpan_s) - page_at(track, panel, t_s - kDirectionSpan_s);
  const double length = length_of(along);
  return length < 0.3 ? Vec2{} : (1 / length) * along;
}

/// The points of a line that stays within `tolerance` of all points (Douglas and Peucker, 1973),
/// without recursion.
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance) {
  if (points.size() < 3) return points;
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  // A stack of chords to be examined: a track of a million points would be too deep for recursion.
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const Vec2 chord = points[last] - points[first];
    const double length = length_of(chord);
    double farthest = tolerance;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const Vec2 to = points[i] - points[first];
      const double distance = length > 0 ? std::abs(cross(chord, to)) / length : length_of(to);
      if (distance <= farthest) continue;
      farthest = distance;
      split = i;
    }
    if (split == first) continue;
    keep[split] = true;
    open.emplace_back(first, split);
    open.emplace_back(split, last);
  }
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) kept.push_back(points[i]);
  }
  return kept;
}

/// A part of a track with or without known poses, thinned to the visible resolution.
struct Run {
  bool in_gap = false;
  std::vector<Vec2> points;
};

std::vector<Run> runs_of(const PictureTrack& track, const Panel& panel, double t0_s, double t1_s,
                         double least_step) {
  std::vector<Run> runs;
  const TrackPoint* last = nullptr;
  Vec2 pending;
  bool is_pending = false;
  for (const TrackPoint& point : track.points) {
    if (point.t_s < t0_s || point.t_s > t1_s) continue;
    const Vec2 p = panel.to_page(point.X_WB.position());
    const bool in_gap = last != nullptr && is_in_gap(track, last->t_s, point.t_s);
    if (runs.empty() || runs.back().in_gap != in_gap) {
      const Vec2 start = last == nullptr ? p : panel.to_page(last->X_WB.position());
      // The last point of a part is always drawn, even if it is too near to the one before.
      if (is_pending) runs.back().points.push_back(pending);
      runs.push_back({in_gap, {start}});
      is_pending = false;
    }
    if (length_of(p - runs.back().points.back()) >= least_step) {
      runs.back().points.push_back(p);
      is_pending = false;
    } else {
      pending = p;
      is_pending = true;
    }
    last = &point;
  }
  if (is_pending) runs.back().points.push_back(pending);
  return runs;
}

void draw_line(Stage& stage, const PictureTrack& track) {
  const TrackLook look = look_of(track);
  auto runs = runs_of(track, stage.panel, track.points.front().t_s, track.points.back().t_s,
                      look.is_strong ? 0.4 : 0.8);
  for (Run& run : runs) {
    for (const Vec2 p : run.points)
      stage.labels.weigh(p, look.is_strong ? kStrongWeight : kFaintWeight);
    run.points = simplified(run.points, look.is_strong ? 0.08 : 0.12);
  }
  for (const Run& run : runs) {
    // White edges of all parts first, so that none covers the line of another.
    if (!look.is_strong || run.in_gap) continue;
    stage.pen.path(run.points, false);
    stage.pen.stroke(kWhite, look.width + 1.6, 0.85);
  }
  for (const Run& run : runs) stroke_track(stage.pen, track, run.points, run.in_gap);
  for (const Run& run : runs) {
    if (!run.in_gap) continue;
    const Vec2 a = run.points.front();
    const Vec2 b = run.points.back();
    if (length_of(b - a) >= kShortGap) continue;
    draw_gap_mark(stage.pen, 0.5 * (a + b), rgb_of(track.colour, track.kind));
  }
}

void draw_ticks(Stage& stage, const PictureTrack& track) {
  const TrackLook look = look_of(track);
  const Rgb colour = rgb_of(track.colour, track.kind);
  const double tick_s = stage.picture.tick_s;
  const double first = std::ceil(track.points.front().t_s / tick_s);
  const double last = std::floor(track.points.back().t_s / tick_s);
  // A million ticks would be a solid band, and slow.
  if (last - first > 2000) return;
  std::vector<Vec2> ends;
  for (double k = first; k <= last; k += 1) {
    const Vec2 at = page_at(track, stage.panel, k * tick_s);
    const Vec2 along = direction_at(track, stage.panel, k * tick_s);
    if (look.is_strong && std::fmod(k, kTicksPerLabel) == 0) {
      stage.pen.disc(at, 2.1);
      stage.pen.fill_keeping_path(colour);
      stage.pen.stroke(kWhite, 0.6);
      continue;
    }
    const Vec2 across = look.tick * Vec2{-along.y, along.x};
    ends.push_back(at - across);
    ends.push_back(at + across);
  }
  stage.pen.segments(ends);
  stage.pen.stroke(colour, look.is_strong ? 1.1 : 0.7, look.alpha);
}

void draw_ends(Stage& stage, const PictureTrack& track) {
  if (!look_of(track).is_strong) return;
  const Rgb colour = rgb_of(track.colour, track.kind);
  const Vec2 start = stage.panel.to_page(track.points.front().X_WB.position());
  const Vec2 end = stage.panel.to_page(track.points.back().X_WB.position());
  stage.pen.disc(start, 2.6);
  stage.pen.fill_keeping_path(kWhite);
  stage.pen.stroke(colour, 1.2);
  // No arrow at the end: after the pose was lost the direction is unknown.
  if (track.pose_lost_t_s) {
    draw_lost_mark(stage.pen, page_at(track, stage.panel, *track.pose_lost_t_s), colour);
    return;
  }
  const Vec2 along = direction_at(track, stage.panel, track.points.back().t_s);
  if (along == Vec2{}) return;
  const Vec2 across = {-along.y, along.x};
  stage.pen.path(
      {end + 4.5 * along, end - 2.2 * along + 3.2 * across, end - 2.2 * along - 3.2 * across},
      true);
  stage.pen.fill_keeping_path(colour);
  stage.pen.stroke(kWhite, 0.5);
}

/// The order of drawing, from the bottom: context, dashed tracks, captured tracks.
int depth_of(const PictureTrack& track) {
  if (track.odometry_only) return 1;
  if (track.kind == Kind::kHunter) return 3;
  return look_of(track).is_strong ? 2 : 0;
}

std::vector<const PictureTrack*> in_drawing_order(const Picture& picture) {
  std::vector<const PictureTrack*> tracks;
  for (const PictureTrack& track : picture.tracks) {
    if (!track.points.empty()) tracks.push_back(&track);
  }
  std::stable_sort(tracks.begin(), tracks.end(), [](const PictureTrack* a, const PictureTrack* b) {
    return depth_of(*a) < depth_of(*b);
  });
  return tracks;
}

void label_times(Stage& stage, const PictureTrack& track) {
  const double label_s = kTicksPerLabel * stage.picture.tick_s;
  const TextStyle style{.size = 7.5, .colour = rgb_of(track.colour, track.kind), .halo = true};
  const double first = std::ceil(track.points.front().t_s / label_s);
  const double last = std::floor(track.points.back().t_s / label_s);
  if (last - first > 200) return;
  for (double k = first; k <= last; k += 1) {
    const double t_s = k * label_s;
    label_beside(stage, page_at(track, stage.panel, t_s), 3, fmt::format("{:g} s", t_s + 0.0),
                 style);
  }
}

/// Names of few simulated robots, at the starts of their tracks.
void label_faint(Stage& stage, const std::vector<const PictureTrack*>& tracks) {
  if (tracks.size() > kMostNamedTracks) return;
  for (const PictureTrack* track : tracks) {
    const Rgb colour = track->colour.empty() ? kSoftInk : rgb_of(track->colour);
    label_beside(stage, stage.panel.to_page(track->points.front().X_WB.position()), 3, track->label,
                 {.size = 8, .colour = colour, .halo = true});
  }
}

}  // namespace

TrackLook look_of(const PictureTrack& track) noexcept {
  if (track.odometry_only) return {0.9, 0.9, 1.6, false};
  const bool is_strong = track.kind == Kind::kRecordedRobot || track.kind == Kind::kHunter;
  return is_strong ? TrackLook{1.6, 1, 3, true} : TrackLook{0.7, 0.75, 1.6, false};
}

void stroke_track(Pen& pen, const PictureTrack& track, const std::vector<Vec2>& points,
                  bool in_gap) {
  const TrackLook look = look_of(track);
  const Rgb colour = rgb_of(track.colour, track.kind);
  pen.path(points, false);
  if (in_gap) {
    pen.stroke_dashed(colour, look.width, 1.6, 1.8, look.alpha);
  } else if (track.odometry_only) {
    pen.stroke_dashed(colour, look.width, 3.6, 2.4, look.alpha);
  } else {
    pen.stroke(colour, look.width, look.alpha);
  }
}

void draw_lost_mark(Pen& pen, Vec2 at, Rgb colour) {
  constexpr double kArm = 3.6;
  for (const auto& [rgb, width] : {std::pair{kWhite, 4.0}, std::pair{colour, 2.0}}) {
    pen.line(at + Vec2{-kArm, -kArm}, at + Vec2{kArm, kArm});
    pen.stroke(rgb, width);
    pen.line(at + Vec2{-kArm, kArm}, at + Vec2{kArm, -kArm});
    pen.stroke(rgb, width);
  }
}

void draw_gap_mark(Pen& pen, Vec2 at, Rgb colour) {
  pen.disc(at, 3.4);
  pen.stroke_dashed(colour, 1.0, 1.6, 1.1);
}

void draw_tracks(Stage& stage) {
  const auto tracks = in_drawing_order(stage.picture);
  for (const PictureTrack* track : tracks) {
    draw_line(stage, *track);
    if (tracks.size() <= kMostTracksWithTicks || look_of(*track).is_strong) {
      draw_ticks(stage, *track);
    }
  }
  for (const PictureTrack* track : tracks) draw_ends(stage, *track);
}

void label_tracks(Stage& stage) {
  auto tracks = in_drawing_order(stage.picture);
  std::vector<const PictureTrack*> faint;
  std::erase_if(tracks, [&](const PictureTrack* track) {
    const bool is_strong = look_of(*track).is_strong;
    if (!is_strong && !track->odometry_only) faint.push_back(track);
    return !is_strong;
  });
  if (tracks.size() > kMostLabels) return;
  for (const PictureTrack* track : tracks) {
    const TextStyle style{
        .size = 9, .colour = rgb_of(track->colour, track->kind), .bold = true, .halo = true};
    label_beside(stage, stage.panel.to_page(track->points.front().X_WB.position()), 4, track->label,
                 style);
    if (!track->pose_lost_t_s) continue;
    label_beside(stage, page_at(*track, stage.panel, *track->pose_lost_t_s), 6,
                 fmt::format("pose lost at {:.1f} s", *track->pose_lost_t_s), style);
  }
  // Names before times, and those of real robots first: they take the better places.
  label_faint(stage, faint);
  for (const PictureTrack* track : tracks) label_times(stage, *track);
}

void draw_trails(Stage& stage, double t_s) {
  for (const PictureTrack* track : in_drawing_order(stage.picture)) {
    if (track->odometry_only) continue;
    const Rgb colour = rgb_of(track->colour, track->kind);
    for (const Run& run : runs_of(*track, stage.panel, t_s - stage.picture.tick_s, t_s, 0.8)) {
      stage.pen.path(run.points, false);
      stage.pen.stroke(colour, look_of(*track).is_strong ? 1.4 : 0.8, 0.55);
    }
  }
}

}  // namespace rave::report
