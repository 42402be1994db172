// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/input_files.hpp"

namespace rave::config {

/// The state of one map cell.
enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

/// Images with more pixels than this are refused.
inline constexpr std::size_t kMaxMapPixels = std::size_t{64} * 1000 * 1000;

/// A grey image: one brightness per pixel, row 0 at the top.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> shade;   ///< 0 black to 255 white; the mean of the colour channels.
  std::vector<std::uint8_t> opaque;  ///< 0 where the image is partly or fully transparent, else 1.
};

/// A map in the sense of ROS `map_server`. Map frame: origin at the lower left corner of the image,
/// x to the right, y up; `origin_*` is the pose of that frame in the world.
struct MapImage {
  int width = 0;   ///< Cells along x.
  int height = 0;  ///< Cells along y.
  double resolution_m = 0;
  double origin_x_m = 0;
  double origin_y_m = 0;
  double origin_yaw_rad = 0;
  bool raw = false;  ///< Its grey values are per cent of occupancy (`mode: raw`).
  /// Row by row from the top (largest y); size width * height.
  std::vector<CellState> cells;

  /// Row 0 is the top of the image.
  [[nodiscard]] CellState at(int column, int row) const {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)];
  }
};

/// Reads a map: its YAML (keys image, resolution, origin, negate, occupied_thresh, free_thresh and
/// optionally mode; strict) and the image it names (PGM or PNG), whose path is relative to the
/// YAML. Errors name the file and, for the YAML, line and column.
///
/// Source of the rule: http://wiki.ros.org/map_server, "Value Interpretation". With x the mean of
/// the colour channels (0 to 255) a cell's occupancy is p = (255 - x) / 255, or x / 255 if negated;
/// occupied if p > occupied_thresh, free if p < free_thresh, else unknown. Mode `scale` differs in
/// that transparent pixels are unknown (the gradient between the thresholds is unknown here as
/// well); in mode `raw` x itself is the occupancy in percent and above 100 unknown. Transparency is
/// ignored in the other modes.
/// Both are taken from `files` if they are there.
[[nodiscard]] Result<MapImage> read_map(const std::filesystem::path& yaml_path,
                                        const InputFiles& files = {});

/// Like read_map(), for YAML text that was already loaded; `yaml_path` is the base of the image
/// path.
[[nodiscard]] Result<MapImage> read_map_text(std::string_view yaml,
                                             const std::filesystem::path& yaml_path,
                                             const InputFiles& files = {});

/// A map as it is in its two files.
struct MapFiles {
  InputFiles::Content yaml;
  std::filesystem::path image_path;
  InputFiles::Content image;  ///< Not decoded.
};
/// Reads both from `files` or, if they are not there, from the disk. Errors: as read_map(), except
/// those of the image's format.
[[nodiscard]] Result<MapFiles> read_map_files(const std::filesystem::path& yaml_path,
                                              const InputFiles& files);

/// Decodes PGM (P2 or P5, comments, up to 16 bits) or PNG (grey, RGB, palette, alpha; 16 bits are
/// reduced to 8); the magic bytes select the format. `file_name` is used in messages. Errors:
/// kParse.
[[nodiscard]] Result<GreyImage> decode_image(std::string_view bytes, std::string_view file_name);
[[nodiscard]] Result<GreyImage> decode_pgm(std::string_view bytes, std::string_view file_name);
[[nodiscard]] Result<GreyImage> decode_png(std::string_view bytes, std::string_view file_name);

/// A rectangle of cells: columns and rows count from the left and from the top.
struct CellRectangle {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

/// An axis-aligned rectangle in the map frame (before the origin's pose is applied), metres.
struct MapRectangle {
  double min_x_m = 0;
  double min_y_m = 0;
  double max_x_m = 0;
  double max_y_m = 0;
};

/// A cover of the occupied cells by few rectangles, exact and without overlaps. Greedy: each is the
/// larger of growing right first and growing down first. Deterministic; ordered by row and column.
[[nodiscard]] std::vector<CellRectangle> cell_rectangles_of(const MapImage& map);
[[nodiscard]] std::vector<MapRectangle> rectangles_of(const MapImage& map);

}  // namespace rave::config
