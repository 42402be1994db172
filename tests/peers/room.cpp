// SPDX-License-Identifier: Apache-2.0
#include "room.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <utility>

#include "arguments.hpp"

namespace peer {
namespace {

/// From (x, y) to the nearest point of a wall.
Room::Near nearest(const Wall& wall, double x, double y) {
  const double ex = wall.x2 - wall.x1;
  const double ey = wall.y2 - wall.y1;
  const double length2 = ex * ex + ey * ey;
  const double along =
      length2 > 0 ? std::clamp(((x - wall.x1) * ex + (y - wall.y1) * ey) / length2, 0.0, 1.0) : 0;
  const double dx = wall.x1 + along * ex - x;
  const double dy = wall.y1 + along * ey - y;
  return {std::hypot(dx, dy), std::atan2(dy, dx)};
}

}  // namespace

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
    if (n.size() == 5) {
      add_box(n);
    } else if (n.size() == 4) {
      walls_.push_back({n[0], n[1], n[2], n[3]});
    } else {
      give_up(std::string(path)
                  .append(": a wall is x1 y1 x2 y2, a box x y yaw_deg length width, not: ")
                  .append(line));
    }
  }
}

void Room::add_box(const std::vector<double>& n) {
  const double yaw = n[2] * std::numbers::pi / 180;
  const auto corner = [&](double forward, double left) {
    const double x = forward * n[3] / 2;
    const double y = left * n[4] / 2;
    return std::pair{n[0] + std::cos(yaw) * x - std::sin(yaw) * y,
                     n[1] + std::sin(yaw) * x + std::cos(yaw) * y};
  };
  const std::pair<double, double> corners[] = {corner(1, 1), corner(-1, 1), corner(-1, -1),
                                               corner(1, -1)};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [x1, y1] = corners[i];
    const auto& [x2, y2] = corners[(i + 1) % 4];
    walls_.push_back({x1, y1, x2, y2});
  }
}

std::vector<Room::Near> Room::within(double x, double y, double radius) const {
  std::vector<Near> all;
  for (const Wall& wall : walls_) {
    const Near near = nearest(wall, x, y);
    if (near.distance < radius) all.push_back(near);
  }
  return all;
}

double Room::clearance(double x, double y) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) least = std::min(least, nearest(wall, x, y).distance);
  return least;
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
