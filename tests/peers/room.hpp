// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace peer {

struct Wall {
  double x1 = 0;
  double y1 = 0;
  double x2 = 0;
  double y2 = 0;
};

/// What the peer alone can feel: walls of no thickness, metres.
class Room {
 public:
  /// A room of 4 m by 3 m with a door of 0.8 m and a box in it.
  Room();
  /// From a text file: `x1 y1 x2 y2` is a wall, `x y yaw_deg length width` a box about its centre;
  /// `#` begins a comment.
  explicit Room(const std::string& path);

  /// Distance from a point along a direction to the first wall; infinity if there is none.
  [[nodiscard]] double distance(double x, double y, double direction) const;

  /// The point of a wall that is nearest to a place.
  struct Near {
    double distance = 0;
    double direction = 0;  ///< From the place to it, radians.
  };
  /// Of each wall that is nearer than `radius`.
  [[nodiscard]] std::vector<Near> within(double x, double y, double radius) const;
  /// Distance to the nearest wall; infinity if there is none.
  [[nodiscard]] double clearance(double x, double y) const;

 private:
  void add_box(const std::vector<double>& n);

  std::vector<Wall> walls_;
};

}  // namespace peer
