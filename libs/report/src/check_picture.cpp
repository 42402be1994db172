// SPDX-License-Identifier: Apache-2.0
// Numbers and texts of a picture may come from any recording, so they are checked before anything
// is drawn.
#include "check_picture.hpp"

#include <cmath>

#include "rave/base/text_width.hpp"

namespace rave::report {
namespace {

/// Larger coordinates are mistakes, and the page's arithmetic would lose precision.
constexpr double kLargestCoordinate_m = 1e7;

Status check_point(Vec2 p, std::string_view what, std::string_view label) {
  // NaN fails this condition.
  if (std::abs(p.x) <= kLargestCoordinate_m && std::abs(p.y) <= kLargestCoordinate_m) {
    return {};
  }
  return fail(ErrorCode::kInvalidArgument,
              "picture: {} of `{}` is ({}, {}); expected finite metres within 1e7", what, label,
              p.x, p.y);
}

Status check_time(double t_s, std::string_view what, std::string_view label) {
  if (std::isfinite(t_s)) return {};
  return fail(ErrorCode::kInvalidArgument, "picture: {} of `{}` is {}; expected finite seconds",
              what, label, t_s);
}

Status check_text(std::string_view text, std::string_view what) {
  // cairo would refuse the whole picture.
  if (is_utf8(text)) return {};
  return fail(ErrorCode::kInvalidArgument, "picture: the {} is not valid UTF-8", what);
}

Status check_colour(std::string_view colour, std::string_view label) {
  if (colour.empty()) return {};
  const bool good = colour.size() == 7 && colour[0] == '#' &&
                    colour.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string_view::npos;
  if (good) return {};
  return fail(ErrorCode::kInvalidArgument, "picture: colour `{}` of `{}`: expected #rrggbb",
              is_utf8(colour) ? colour : "?", label);
}

Status check_look(std::string_view label, std::string_view colour) {
  RAVE_TRY(check_text(label, "label of a body, robot, track or sighting"));
  return check_colour(colour, label);
}

Status check_outline(const std::vector<Vec2>& outline_W, std::string_view label) {
  if (outline_W.size() < 3) {
    return fail(ErrorCode::kInvalidArgument,
                "picture: the outline of `{}` has {} corners; expected 3 or more", label,
                outline_W.size());
  }
  for (const Vec2 corner : outline_W) RAVE_TRY(check_point(corner, "a corner", label));
  return {};
}

Status check_track(const PictureTrack& track) {
  RAVE_TRY(check_look(track.label, track.colour));
  double last_t_s = track.points.empty() ? 0 : track.points.front().t_s;
  for (const TrackPoint& point : track.points) {
    RAVE_TRY(check_time(point.t_s, "a track time", track.label));
    RAVE_TRY(check_point(point.X_WB.position(), "a track point", track.label));
    RAVE_TRY(check_time(point.X_WB.yaw, "a yaw", track.label));
    if (point.t_s < last_t_s) {
      return fail(ErrorCode::kInvalidArgument, "picture: track `{}` steps back from {} s to {} s",
                  track.label, last_t_s, point.t_s);
    }
    last_t_s = point.t_s;
  }
  for (const PoseGap& gap : track.gaps) {
    if (std::isfinite(gap.t0_s) && std::isfinite(gap.t1_s) && gap.t0_s <= gap.t1_s) continue;
    return fail(ErrorCode::kInvalidArgument,
                "picture: pose gap of `{}` from {} s to {} s; expected finite, rising seconds",
                track.label, gap.t0_s, gap.t1_s);
  }
  return check_time(track.pose_lost_t_s.value_or(0), "the time of the lost pose", track.label);
}

Status check_instant(const PictureInstant& instant) {
  RAVE_TRY(check_time(instant.t_s, "the time", "instant"));
  for (const PictureRobot& robot : instant.robots) {
    RAVE_TRY(check_look(robot.label, robot.colour));
    RAVE_TRY(check_outline(robot.outline_W, robot.label));
    RAVE_TRY(check_point(robot.X_WB.position(), "the position", robot.label));
    RAVE_TRY(check_time(robot.X_WB.yaw, "the yaw", robot.label));
  }
  for (const PictureHit& hit : instant.hits) {
    RAVE_TRY(check_point(hit.from_W, "the start", "laser hit"));
    RAVE_TRY(check_point(hit.to_W, "the end", "laser hit"));
  }
  for (const PictureSighting& sighting : instant.sightings) {
    RAVE_TRY(check_look(sighting.label, sighting.colour));
    RAVE_TRY(check_point(sighting.from_W, "the start", "sighting"));
    RAVE_TRY(check_point(sighting.to_W, "the measured place", "sighting"));
    RAVE_TRY(check_point(sighting.tube_W.value_or(Vec2{}), "the tube", "sighting"));
  }
  return {};
}

}  // namespace

Status check_picture(const Picture& picture) {
  RAVE_TRY(check_text(picture.title, "title"));
  RAVE_TRY(check_text(picture.subtitle, "subtitle"));
  for (const std::string& line : picture.caption) RAVE_TRY(check_text(line, "caption"));
  if (!std::isfinite(picture.tick_s) || picture.tick_s <= 0) {
    return fail(ErrorCode::kInvalidArgument, "picture: tick_s is {}; expected more than 0 s",
                picture.tick_s);
  }
  for (const PictureBody& body : picture.bodies) {
    RAVE_TRY(check_look(body.label, body.colour));
    RAVE_TRY(check_outline(body.outline_W, body.label));
  }
  for (const PictureTrack& track : picture.tracks) RAVE_TRY(check_track(track));
  if (picture.instant) RAVE_TRY(check_instant(*picture.instant));
  return {};
}

}  // namespace rave::report
