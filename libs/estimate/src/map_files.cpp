// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/map_files.hpp"

#include <fmt/format.h>

#include <optional>

namespace rave::estimate {
namespace {

/// The shades that map_saver of ROS writes: 0, 254 and 205.
constexpr char kOccupied = '\x00';
constexpr char kFree = '\xfe';
constexpr char kUnknown = '\xcd';

/// `probability(column, row)`: empty if nothing is known.
template <class Probability>
std::string image_of(const GridFrame& frame, const MapThresholds& thresholds,
                     const Probability& probability) {
  std::string image = fmt::format("P5\n{} {}\n255\n", frame.columns, frame.rows);
  // Images begin at the top, grids at the origin, which is the lower left corner.
  for (int row = frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < frame.columns; ++column) {
      const std::optional<double> p = probability(column, row);
      const bool known = p && !(*p <= thresholds.occupied && *p >= thresholds.free);
      image += !known ? kUnknown : *p > thresholds.occupied ? kOccupied : kFree;
    }
  }
  return image;
}

}  // namespace

std::string map_image(const OccupancyGrid& grid, const MapThresholds& thresholds) {
  return image_of(grid.frame(), thresholds, [&](int column, int row) -> std::optional<double> {
    if (!grid.seen(column, row)) return std::nullopt;
    return grid.probability(column, row);
  });
}

std::string map_image(const GridFrame& frame, std::span<const std::uint8_t> percent,
                      const MapThresholds& thresholds) {
  return image_of(frame, thresholds, [&](int column, int row) -> std::optional<double> {
    const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                           static_cast<std::size_t>(column);
    if (percent[at] > 100) return std::nullopt;
    return percent[at] / 100.0;
  });
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
