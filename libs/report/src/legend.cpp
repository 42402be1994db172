// SPDX-License-Identifier: Apache-2.0
// The legend draws its symbols with the functions that draw the picture, so that both look alike.
#include "legend.hpp"

#include <algorithm>

#include "stage.hpp"

namespace rave::report {
namespace {

constexpr std::size_t kColumns = 4;
constexpr double kRowHeight = 14.5;

Vec2 left_of(const PageBox& box) { return {box.x0 + 2, middle_of(box).y}; }
Vec2 right_of(const PageBox& box) { return {box.x1 - 4, middle_of(box).y}; }

std::string counted(std::size_t count, Kind kind) {
  const KindStyle style = palette_for(kind);
  return count == 1 ? std::string(style.singular) : fmt::format("{} {}", count, style.plural);
}

/// A legend entry with the look of a track.
LegendEntry line_entry(const PictureTrack& like, bool in_gap, std::string text) {
  PictureTrack look;
  look.kind = like.kind;
  look.colour = like.colour;
  look.odometry_only = like.odometry_only;
  return {[look, in_gap](Pen& pen, const PageBox& box) {
            stroke_track(pen, look, {left_of(box), right_of(box)}, in_gap);
          },
          std::move(text)};
}

/// Tracks by name if they are few and each is prominent or has a colour; otherwise one line per
/// kind.
void add_lines(const Picture& picture, std::vector<LegendEntry>& entries) {
  for (const Kind kind : {Kind::kRecordedRobot, Kind::kHunter, Kind::kSimulatedRobot, Kind::kOther,
                          Kind::kLandmark, Kind::kMappedWall, Kind::kVirtualObstacle}) {
    std::vector<const PictureTrack*> tracks;
    for (const PictureTrack& track : picture.tracks) {
      if (track.kind == kind && !track.odometry_only && !track.points.empty()) {
        tracks.push_back(&track);
      }
    }
    if (tracks.empty()) continue;
    const bool is_told_apart = std::ranges::all_of(tracks, [](const PictureTrack* track) {
      return look_of(*track).is_strong || !track->colour.empty();
    });
    if (!is_told_apart || tracks.size() > kMostNamedTracks) {
      entries.push_back(line_entry(*tracks.front(), false, counted(tracks.size(), kind)));
      continue;
    }
    for (const PictureTrack* track : tracks) {
      const std::string kind_name(palette_for(kind).singular);
      std::string text = fmt::format("{} ({})", track->label, kind_name);
      if (track->label.empty() || track->label == kind_name) text = kind_name;
      entries.push_back(line_entry(*track, false, std::move(text)));
    }
  }
}

template <class Has>
bool any_track(const Picture& picture, Has has) {
  return std::ranges::any_of(picture.tracks, [&](const PictureTrack& track) {
    return !track.points.empty() && has(track);
  });
}

void add_track_marks(const Picture& picture, std::vector<LegendEntry>& entries) {
  PictureTrack neutral;
  neutral.kind = Kind::kRecordedRobot;
  neutral.colour = "#55585e";
  PictureTrack dashed = neutral;
  dashed.odometry_only = true;
  const Rgb grey = rgb_of(neutral.colour);
  if (any_track(picture, [](const PictureTrack& track) { return track.odometry_only; })) {
    entries.push_back(line_entry(dashed, false, "odometry alone"));
  }
  if (any_track(picture, [](const PictureTrack& track) { return !track.gaps.empty(); })) {
    entries.push_back({[neutral, grey](Pen& pen, const PageBox& box) {
                         stroke_track(pen, neutral, {left_of(box), middle_of(box)}, true);
                         draw_gap_mark(pen, right_of(box) - Vec2{4, 0}, grey);
                       },
                       "gap in the poses (ring: short)"});
  }
  if (any_track(picture, [](const PictureTrack& t) { return t.pose_lost_t_s.has_value(); })) {
    entries.push_back(
        {[grey](Pen& pen, const PageBox& box) { draw_lost_mark(pen, middle_of(box), grey); },
         "pose lost from here on"});
  }
  const bool strong =
      any_track(picture, [](const PictureTrack& track) { return look_of(track).is_strong; });
  entries.push_back({[neutral, grey](Pen& pen, const PageBox& box) {
                       stroke_track(pen, neutral, {left_of(box), right_of(box)}, false);
                       for (const double along : {0.2, 0.55, 0.9}) {
                         const double x = box.x0 + 2 + along * (box.width() - 6);
                         pen.line({x, left_of(box).y - 3}, {x, left_of(box).y + 3});
                         pen.stroke(grey, 1.1);
                       }
                     },
                     fmt::format("tick each {:g} s", picture.tick_s)});
  if (!strong) return;
  entries.push_back({[grey](Pen& pen, const PageBox& box) {
                       const Vec2 a = left_of(box) + Vec2{3, 0};
                       const Vec2 b = right_of(box);
                       pen.line(a, b);
                       pen.stroke(grey, 1.6);
                       pen.disc(a, 2.6);
                       pen.fill_keeping_path(kWhite);
                       pen.stroke(grey, 1.2);
                       pen.path({b + Vec2{3, 0}, b + Vec2{-4, -3.2}, b + Vec2{-4, 3.2}}, true);
                       pen.fill(grey);
                     },
                     "start and end"});
}

std::vector<Vec2> square(const PageBox& box, double half_width, double half_height) {
  const Vec2 c = middle_of(box);
  return {c + Vec2{-half_width, -half_height}, c + Vec2{half_width, -half_height},
          c + Vec2{half_width, half_height}, c + Vec2{-half_width, half_height}};
}

void add_bodies(const Picture& picture, std::vector<LegendEntry>& entries) {
  for (const Kind kind : kAllKinds) {
    const auto is_of_kind = [&](const auto& body) { return body.kind == kind; };
    const auto count = static_cast<std::size_t>(
        std::count_if(picture.bodies.begin(), picture.bodies.end(), is_of_kind));
    if (count == 0) continue;
    const auto first = std::find_if(picture.bodies.begin(), picture.bodies.end(), is_of_kind);
    // With the colour of the first one: bodies of a kind mostly have the same.
    const Rgb colour = rgb_of(first->colour, kind);
    entries.push_back({[kind, colour](Pen& pen, const PageBox& box) {
                         if (kind == Kind::kLandmark) {
                           pen.disc(middle_of(box), 3);
                           pen.fill(colour);
                         } else {
                           draw_body(pen, square(box, 9, 4.5), kind, colour);
                         }
                       },
                       counted(count, kind)});
  }
}

void add_sweep(const PictureInstant& instant, std::vector<LegendEntry>& entries) {
  if (instant.hits.empty()) return;
  entries.push_back(
      {[](Pen& pen, const PageBox& box) {
         const Vec2 c = middle_of(box);
         const Rgb colour = rgb_of("", Kind::kRecordedRobot);
         pen.path({c + Vec2{-9, 0}, c + Vec2{8, -5}, c + Vec2{10, 0}, c + Vec2{8, 5}}, true);
         pen.fill_keeping_path(colour, 0.12);
         pen.stroke(colour, 0.5, 0.4);
       },
       "swept by a robot's laser"});
}

void add_instant(const PictureInstant& instant, std::vector<LegendEntry>& entries) {
  for (const Kind kind : kAllKinds) {
    const auto is_of_kind = [&](const auto& robot) { return robot.kind == kind; };
    const auto count = static_cast<std::size_t>(
        std::count_if(instant.robots.begin(), instant.robots.end(), is_of_kind));
    if (count == 0) continue;
    const Rgb colour = rgb_of("", kind);
    entries.push_back({[kind, colour](Pen& pen, const PageBox& box) {
                         const Vec2 c = middle_of(box);
                         std::vector<Vec2> outline;
                         for (const Vec2 d :
                              {Vec2{5, 0}, Vec2{3.5, 3.5}, Vec2{0, 5}, Vec2{-3.5, 3.5}, Vec2{-5, 0},
                               Vec2{-3.5, -3.5}, Vec2{0, -5}, Vec2{3.5, -3.5}}) {
                           outline.push_back(c + d);
                         }
                         draw_robot(pen, outline, c, c + Vec2{5, 0}, kind, colour);
                       },
                       counted(count, kind)});
  }
  for (const Kind kind : kAllKinds) {
    const auto count = std::count_if(instant.hits.begin(), instant.hits.end(),
                                     [&](const PictureHit& hit) { return hit.kind == kind; });
    if (count == 0) continue;
    entries.push_back({[kind](Pen& pen, const PageBox& box) {
                         const Vec2 c = middle_of(box);
                         draw_hits(pen, {c - Vec2{7, 0}, c, c + Vec2{7, 0}}, kind);
                       },
                       fmt::format("laser hit on {}", palette_for(kind).singular)});
  }
  add_sweep(instant, entries);
  if (instant.sightings.empty()) return;
  entries.push_back(
      {[](Pen& pen, const PageBox& box) {
         const Vec2 to = right_of(box) - Vec2{5, 0};
         draw_sighting(pen, left_of(box), to, to + Vec2{6, -3}, rgb_of("", Kind::kRecordedRobot));
       },
       "real sighting, line to the truth"});
}

struct Slot {
  std::size_t column = 0;
  std::size_t row = 0;
};

struct PlacedGroup {
  Slot heading;
  std::vector<Slot> entries;
};

/// Arranges the groups in columns with this number of rows; a short group goes below the previous
/// one if it fits. Empty if there are not enough columns.
std::vector<PlacedGroup> placed_in(const std::vector<LegendGroup>& groups, std::size_t rows) {
  std::vector<PlacedGroup> placed;
  Slot next;
  for (const LegendGroup& group : groups) {
    const std::size_t count = group.entries.size();
    const bool fits_below = next.row > 0 && next.row + 2 + count <= rows;
    if (!fits_below && next.row > 0) next = {next.column + 1, 0};
    if (fits_below) ++next.row;  // A blank row between them.
    std::size_t each = fits_below ? count : rows - 1;
    const std::size_t columns = (count + each - 1) / each;
    // Columns of equal height.
    if (&group == &groups.back()) each = (count + columns - 1) / columns;
    placed.push_back({next, {}});
    for (std::size_t i = 0; i < count; ++i) {
      placed.back().entries.push_back({next.column + i / each, next.row + 1 + i % each});
    }
    next = placed.back().entries.back();
    ++next.row;
    if (next.column >= kColumns) return {};
  }
  return placed;
}

/// The least number of rows, at least two, that holds the groups.
std::size_t rows_of(const std::vector<LegendGroup>& groups) {
  if (groups.empty()) return 0;
  std::size_t rows = 2;
  // Ends, since with enough rows each group fits into one column.
  while (placed_in(groups, rows).empty()) ++rows;
  return rows;
}

}  // namespace

std::vector<LegendGroup> legend_of(const Picture& picture) {
  std::vector<LegendGroup> groups;
  LegendGroup tracks{"Tracks", {}};
  add_lines(picture, tracks.entries);
  if (!tracks.entries.empty()) {
    add_track_marks(picture, tracks.entries);
    groups.push_back(std::move(tracks));
  }
  LegendGroup bodies{"Bodies", {}};
  add_bodies(picture, bodies.entries);
  if (!bodies.entries.empty()) groups.push_back(std::move(bodies));
  if (picture.instant) {
    LegendGroup instant{fmt::format("At t = {:g} s", picture.instant->t_s), {}};
    add_instant(*picture.instant, instant.entries);
    if (!groups.empty() && groups.front().heading == "Tracks") {
      instant.entries.push_back({[](Pen& pen, const PageBox& box) {
                                   pen.line(left_of(box), right_of(box));
                                   pen.stroke(rgb_of("#55585e"), 1.4, 0.55);
                                 },
                                 fmt::format("path of the last {:g} s", picture.tick_s)});
    }
    if (!instant.entries.empty()) groups.push_back(std::move(instant));
  }
  return groups;
}

double height_of(const std::vector<LegendGroup>& groups) {
  if (groups.empty()) return 0;
  return kRowHeight * static_cast<double>(rows_of(groups));
}

void draw_legend(Pen& pen, const std::vector<LegendGroup>& groups, const PageBox& box) {
  const std::vector<PlacedGroup> placed = placed_in(groups, rows_of(groups));
  const double column_width = box.width() / static_cast<double>(kColumns);
  const auto corner_of = [&](Slot slot) {
    return Vec2{box.x0 + column_width * static_cast<double>(slot.column),
                box.y0 + kRowHeight * static_cast<double>(slot.row)};
  };
  const TextStyle heading{.size = 9.5, .colour = kInk, .bold = true};
  const TextStyle style{.size = 9, .colour = kInk};
  for (std::size_t g = 0; g < placed.size(); ++g) {
    pen.text(corner_of(placed[g].heading) + Vec2{0, 9},
             pen.fit(groups[g].heading, column_width - 8, heading), heading);
    for (std::size_t i = 0; i < placed[g].entries.size(); ++i) {
      const LegendEntry& entry = groups[g].entries[i];
      const Vec2 corner = corner_of(placed[g].entries[i]);
      entry.draw(pen, {corner.x, corner.y, corner.x + kSymbolWidth, corner.y + kRowHeight});
      pen.text(corner + Vec2{kSymbolWidth + 4, 10.5},
               pen.fit(entry.text, column_width - kSymbolWidth - 10, style), style);
    }
  }
}

}  // namespace rave::report
