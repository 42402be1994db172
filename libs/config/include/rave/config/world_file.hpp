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

/// An upright prism that stands still, in the world frame.
struct ObstacleFile {
  Located<std::string> name;
  Outline outline;
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  HeightRange z_m{0, 0.5};
  ObstacleLayer layer = ObstacleLayer::kVirtualObstacles;
  std::optional<int> barcode;              ///< What landmark cameras read on it; 0 to 65535.
  std::optional<HeightRange> barcode_z_m;  ///< Unset: z_m.
  std::optional<std::string> colour;       ///< `#rrggbb`; unset: pictures choose.
  bool operator==(const ObstacleFile&) const = default;
};

/// Another place for an obstacle.
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

/// A world file as it was written, with its defaults.
struct WorldFile {
  std::string description;
  std::vector<ObstacleFile> obstacles;  ///< Names are unique.
  std::vector<MapFile> maps;
  bool operator==(const WorldFile&) const = default;
};

/// Reads a world file without opening its maps. Errors: those of rave::read_file, and kParse with
/// file:line:column for what is wrong in it.
[[nodiscard]] Result<WorldFile> read_world_file(const std::filesystem::path& path);
/// The same for a text; `file_name` is for messages.
[[nodiscard]] Result<WorldFile> read_world_text(std::string_view text, std::string_view file_name);

/// Reads one entry of `obstacles:`, a mapping; for who adds an obstacle to a running world.
/// `file_name` is for messages. Errors: kParse.
[[nodiscard]] Result<ObstacleFile> read_obstacle_text(std::string_view text,
                                                      std::string_view file_name);
[[nodiscard]] Result<MoveObstacleFile> read_move_text(std::string_view text,
                                                      std::string_view file_name);

/// YAML with all defaults that read_world_text reads back as an equal value.
[[nodiscard]] std::string write_world(const WorldFile& world);

/// The JSON Schema (draft 07) of world files.
[[nodiscard]] std::string world_schema();

}  // namespace rave::config
