// SPDX-License-Identifier: Apache-2.0
#include "room.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "arguments.hpp"

namespace peer {

Room::Room()
    : walls_{{0, 0, 4, 0},         {4, 0, 4, 1},         {4, 1.8, 4, 3},
             {4, 3, 0, 3},         {0, 3, 0, 0},         {2.5, 1.9, 2.9, 1.9},
             {2.9, 1.9, 2.9, 2.3}, {2.9, 2.3, 2.5, 2.3}, {2.5, 2.3, 2.5, 1.9}} {}

Room::Room(const std::string& path) {
  std::ifstream file(path);
  if (!file) give_up("cannot read " + path);
  for (std::string line; std::getline(file, line);) {
    const std::vector<double> n = parse_numbers(line.substr(0, line.find('#')));
    if (n.empty()) continue;
    if (n.size() != 4) give_up(path + ": a wall is x1 y1 x2 y2, not: " + line);
    walls_.push_back({n[0], n[1], n[2], n[3]});
  }
}

double Room::distance(double x, double y, double direction) const {
  const double dx = std::cos(direction);
  const double dy = std::sin(direction);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) {
    const double ex = wall.x2 - wall.x1;
    const double ey = wall.y2 - wall.y1;
    const double parallel = dx * ey - dy * ex;
    if (parallel == 0) continue;
    const double fx = wall.x1 - x;
    const double fy = wall.y1 - y;
    const double along = (fx * ey - fy * ex) / parallel;
    const double on_wall = (fx * dy - fy * dx) / parallel;
    if (along > 0 && on_wall >= 0 && on_wall <= 1 && along < nearest) nearest = along;
  }
  return nearest;
}

}  // namespace peer
