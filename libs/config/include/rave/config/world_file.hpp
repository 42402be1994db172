// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/located.hpp"
#include "rave/config/shape_file.hpp"

namespace rave::config {

/// A static upright prism in the world frame.
struct ObstacleFile {
  Located<std::string> name;
  Outline outline;
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  HeightRange z_m{0, 0.5};
  ObstacleLayer layer = ObstacleLayer::kVirtualObstacles;
  std::optional<int> barcode;  ///< The code that landmark cameras read on it; 0 to 65535.
  std::optional<HeightRange> barcode_z_m;  ///< Unset: z_m.
  std::optional<std::string> colour;       ///< `#rrggbb`; unset: chosen by the renderer.
  bool operator==(const ObstacleFile&) const = default;
};

/// A new pose for an obstacle.
struct MoveObstacleFile {
  Located<std::string> name;
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  bool operator==(const MoveObstacleFile&) const = default;
};

/// A ROS map_server map whose occupied cells become walls; read it with read_map.
struct MapFile {
  Located<std::string> file;  ///< As written; absolute after expand_scenario.
  HeightRange z_m{0, 2};
  ObstacleLayer layer = ObstacleLayer::kMappedReal;
  bool operator==(const MapFile&) const = default;
};

/// A world file as written, with defaults added.
struct WorldFile {
  std::string description;
  std::vector<ObstacleFile> obstacles;  ///< Names are unique.
  std::vector<MapFile> maps;
  bool operator==(const WorldFile&) const = default;
};

/// Reads a world file without opening its maps. Errors: those of rave::read_file, and kParse with
/// file:line:column for errors in its content.
[[nodiscard]] Result<WorldFile> read_world_file(const std::filesystem::path& path);
/// Like read_world_file(), for a text; `file_name` is used in messages.
[[nodiscard]] Result<WorldFile> read_world_text(std::string_view text, std::string_view file_name);

/// Reads one entry of `obstacles:` (a mapping) for a change of a running world. `file_name` is used
/// in messages. Errors: kParse.
[[nodiscard]] Result<ObstacleFile> read_obstacle_text(std::string_view text,
                                                      std::string_view file_name);
[[nodiscard]] Result<MoveObstacleFile> read_move_text(std::string_view text,
                                                      std::string_view file_name);

/// The world as YAML with all defaults. read_world_text gives an equal value.
[[nodiscard]] std::string write_world(const WorldFile& world);

/// The JSON Schema (draft 07) of world files.
[[nodiscard]] std::string world_schema();

}  // namespace rave::config
