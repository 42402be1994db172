// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/map_files.hpp"

#include <fmt/format.h>

namespace rave::estimate {
namespace {

/// The shades that map_saver of ROS writes: 0, 254 and 205.
constexpr char kOccupied = '\x00';
constexpr char kFree = '\xfe';
constexpr char kUnknown = '\xcd';

}  // namespace

std::string map_image(const OccupancyGrid& grid, const MapThresholds& thresholds) {
  const GridFrame& frame = grid.frame();
  std::string image = fmt::format("P5\n{} {}\n255\n", frame.columns, frame.rows);
  // Images begin at the top, grids at the origin, which is the lower left corner.
  for (int row = frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < frame.columns; ++column) {
      const double p = grid.probability(column, row);
      const bool known =
          grid.seen(column, row) && !(p <= thresholds.occupied && p >= thresholds.free);
      image += !known ? kUnknown : p > thresholds.occupied ? kOccupied : kFree;
    }
  }
  return image;
}

std::string map_yaml(const GridFrame& frame, const MapThresholds& thresholds,
                     std::string_view image, std::string_view comment) {
  return fmt::format(
      "{}image: {}\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\noccupied_thresh: {}\n"
      "free_thresh: {}\n",
      comment, image, frame.resolution_m, frame.origin_W.x, frame.origin_W.y, thresholds.occupied,
      thresholds.free);
}

}  // namespace rave::estimate
