// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "rave/estimate/occupancy_grid.hpp"

namespace rave::estimate {

/// Probabilities above `occupied` mean occupied and below `free` mean free; between them a cell is
/// unknown. The defaults are those of ROS `map_server`, http://wiki.ros.org/map_server.
struct MapThresholds {
  double occupied = 0.65;
  double free = 0.196;
};

/// The grid as a PGM image (P5) for `map_server`: 0 occupied, 254 free, 205 unknown; the first row
/// has the largest y.
[[nodiscard]] std::string map_image(const OccupancyGrid& grid, const MapThresholds& thresholds);

/// The same of cells in percent, row by row from the lowest y; more than 100: unknown.
/// Precondition: as many as the frame has.
[[nodiscard]] std::string map_image(const GridFrame& frame, std::span<const std::uint8_t> percent,
                                    const MapThresholds& thresholds);

/// The YAML file of a map. `image` is the file name of the image. Lines of `comment` begin with
/// `#`; it may be empty.
[[nodiscard]] std::string map_yaml(const GridFrame& frame, const MapThresholds& thresholds,
                                   std::string_view image, std::string_view comment);

}  // namespace rave::estimate
