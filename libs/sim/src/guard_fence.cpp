// SPDX-License-Identifier: Apache-2.0
// Whether a disc that drives along an arc stays inside a polygon. Where the border is far, the free
// distance is skipped; near it, short pieces of the arc are compared exactly with its edges.
#include "guard_fence.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/drive.hpp"

namespace rave::sim {
namespace {

/// A disc that overlaps the fence by no more than this counts as inside.
constexpr double kSlack_m = 1e-6;
/// Spacing at which the way back inside is checked.
constexpr double kInward_m = 1e-3;
/// Arcs of a larger radius are driven as chords of pieces; the error is below a nanometre.
constexpr double kStraight_m = 1e6;
constexpr double kMaxPieceTurn_rad = 0.5;
constexpr double kMaxPiece_m = 0.05;

double point_to_segment(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const Vec2 ab = b - a;
  const double length2 = squared_norm(ab);
  // The foot of the perpendicular, held between both ends.
  const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return std::sqrt(squared_norm(p - (a + t * ab)));
}

bool segments_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  const double abc = cross(b - a, c - a);
  const double abd = cross(b - a, d - a);
  const double cda = cross(d - c, a - c);
  const double cdb = cross(d - c, b - c);
  // Touching without crossing may be missed here; the distances from the end points catch it.
  return ((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0));
}

/// A piece of a path between two of its points, turning by less than pi/2.
struct Piece {
  Vec2 from;
  Vec2 to;
  bool straight = true;
  Vec2 centre;          ///< Of the circle.
  double radius_m = 0;  ///< Of the circle.
  double sense = 1;     ///< 1: counter-clockwise about the centre.

  /// Whether the arc passes the direction `u` as seen from the centre.
  [[nodiscard]] bool passes(Vec2 u) const noexcept {
    const Vec2 first = from - centre;
    const Vec2 last = to - centre;
    // The last term excludes the opposite side of the circle. It suffices because a piece turns by
    // less than a quarter.
    return sense * cross(first, u) >= 0 && sense * cross(u, last) >= 0 && dot(first, u) > 0;
  }

  [[nodiscard]] double distance_to(Vec2 p) const noexcept {
    if (straight) return point_to_segment(p, from, to);
    const double ends = std::sqrt(std::min(squared_norm(p - from), squared_norm(p - to)));
    const Vec2 u = p - centre;
    return passes(u) ? std::min(ends, std::abs(std::sqrt(squared_norm(u)) - radius_m)) : ends;
  }

  /// To the segment ab. Of an arc that crosses it without either end being near it this says
  /// nothing; pieces are shorter than the radius of the body that drives them.
  [[nodiscard]] double distance_to(Vec2 a, Vec2 b) const noexcept {
    if (straight && segments_cross(from, to, a, b)) return 0;
    double least = std::min(
        {point_to_segment(from, a, b), point_to_segment(to, a, b), distance_to(a), distance_to(b)});
    const double length_m = std::sqrt(squared_norm(b - a));
    if (straight || length_m == 0) return least;
    // Where the arc runs along the segment it may be nearest to it.
    const Vec2 normal = (1.0 / length_m) * Vec2{a.y - b.y, b.x - a.x};
    for (const Vec2 u : {radius_m * normal, -radius_m * normal}) {
      if (passes(u)) least = std::min(least, point_to_segment(centre + u, a, b));
    }
    return least;
  }
};

double distance_to_border(std::span<const Vec2> fence_W, const Piece& piece) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fence_W.size(); ++i) {
    least = std::min(least, piece.distance_to(fence_W[i], fence_W[(i + 1) % fence_W.size()]));
  }
  return least;
}

Piece piece_of(const GuardPath& path, double s0_m, double s1_m) noexcept {
  Piece piece;
  const Pose2 X_from = path.at(s0_m);
  piece.from = X_from.position();
  piece.to = path.at(s1_m).position();
  const double radius_m = path.circle_m();
  if (radius_m >= kStraight_m) return piece;
  piece.straight = false;
  piece.radius_m = radius_m;
  const Twist2& drive = path.drive;
  piece.sense = drive.wz > 0 ? 1 : -1;
  // The centre lies abreast of the motion: to the left of a robot that goes ahead for v/w > 0.
  piece.centre =
      piece.from + rotate(sincos(X_from.yaw), {-drive.vy / drive.wz, drive.vx / drive.wz});
  return piece;
}

/// The way back inside.
bool comes_inward(std::span<const Vec2> fence_W, const GuardPath& path, double radius_m,
                  double clearance_m) noexcept {
  // Narrow circles are looked at more closely; a whole one says everything.
  double length_m = path.length_m;
  double look_m = kInward_m;
  if (path.drive.wz != 0) {
    const double circle_m = path.circle_m();
    length_m = std::min(length_m, 2 * kPi * circle_m);
    look_m = std::max(std::min(look_m, 0.05 * circle_m), 1e-12);
  }
  double before_m = clearance_m;
  for (double s_m = 0; s_m < length_m;) {
    s_m = std::min(s_m + look_m, length_m);
    const double now_m = inside_distance(fence_W, path.at(s_m).position()) - radius_m;
    // Each step must lead inward, not only the end: a robot outside may not go round a corner
    // further out.
    if (now_m < before_m) return false;
    // Inside from here on, so the rest of the way is judged like that of any robot inside.
    if (now_m >= -kSlack_m) {
      GuardPath rest = path;
      rest.X_WR = path.at(s_m);
      rest.length_m = path.length_m - s_m;
      return stays_inside(fence_W, rest, radius_m);
    }
    before_m = now_m;
  }
  return true;
}

}  // namespace

// integrate() along the exact arc: s metres take s / |v| seconds, whatever the sign of v.
Pose2 GuardPath::at(double s_m) const noexcept {
  const double speed_mps = speed_of(drive);
  return speed_mps == 0 ? X_WR : integrate(X_WR, drive, s_m / speed_mps);
}

double GuardPath::circle_m() const noexcept {
  return drive.wz == 0 ? std::numeric_limits<double>::infinity()
                       : std::abs(speed_of(drive) / drive.wz);
}

double inside_distance(std::span<const Vec2> fence_W, Vec2 p_W) noexcept {
  double least_m = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (std::size_t i = 0; i < fence_W.size(); ++i) {
    const Vec2 a = fence_W[i];
    const Vec2 b = fence_W[(i + 1) % fence_W.size()];
    least_m = std::min(least_m, point_to_segment(p_W, a, b));
    // Edges that a ray along +x crosses, each corner counted with the edge below it.
    if ((a.y > p_W.y) != (b.y > p_W.y)) {
      const double x = a.x + (p_W.y - a.y) / (b.y - a.y) * (b.x - a.x);
      if (x > p_W.x) inside = !inside;
    }
  }
  return inside ? least_m : -least_m;
}

bool stays_inside(std::span<const Vec2> fence_W, const GuardPath& path, double radius_m) noexcept {
  const double clearance_m = inside_distance(fence_W, path.X_WR.position()) - radius_m;
  if (speed_of(path.drive) == 0 || !(path.length_m > 0)) return true;
  // Outside (put there, or fenced in later): forbidding every motion would leave it there.
  if (clearance_m < -kSlack_m) return comes_inward(fence_W, path, radius_m, clearance_m);
  // A whole circle says everything.
  double length_m = path.length_m;
  // Half the radius of the body: an arc that crossed an edge between its ends would have an end
  // nearer to the edge than the radius. See Piece::distance_to().
  double piece_m = std::min(kMaxPiece_m, 0.5 * radius_m);
  if (path.drive.wz != 0) {
    const double circle_m = path.circle_m();
    length_m = std::min(length_m, 2 * kPi * circle_m);
    piece_m = std::min(piece_m, kMaxPieceTurn_rad * circle_m);
  }
  // A body or a circle without size must not make the loop endless.
  piece_m = std::max(piece_m, 1e-9);
  double free_m = clearance_m;
  for (double s_m = 0; s_m < length_m;) {
    // Nothing can be nearer than the clearance after as long a way.
    if (free_m > piece_m) {
      s_m += free_m;
      if (s_m >= length_m) return true;
    } else {
      const double next_m = std::min(s_m + piece_m, length_m);
      const double border_m = distance_to_border(fence_W, piece_of(path, s_m, next_m));
      if (border_m < radius_m - kSlack_m) return false;
      s_m = next_m;
    }
    free_m = inside_distance(fence_W, path.at(s_m).position()) - radius_m;
    if (free_m < -kSlack_m) return false;
  }
  return true;
}

}  // namespace rave::sim
