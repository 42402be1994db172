// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/described.hpp"
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

/// An edit of the obstacles of a run; exactly one member is set. A scenario plans it for a time, a
/// person requests it during the run. It is the same struct in files, in requests and in records.
struct ObstacleEdit {
  std::optional<ObstacleFile> add_obstacle;
  std::optional<MoveObstacleFile> move_obstacle;
  std::optional<Located<std::string>> remove_obstacle;

  [[nodiscard]] bool empty() const noexcept {
    return !add_obstacle && !move_obstacle && !remove_obstacle;
  }
  /// The name of the obstacle; not for an empty edit.
  [[nodiscard]] const Located<std::string>& name() const {
    if (add_obstacle) return add_obstacle->name;
    return move_obstacle ? move_obstacle->name : *remove_obstacle;
  }
  bool operator==(const ObstacleEdit&) const = default;
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

/// Reads an edit: a mapping with one of `add_obstacle`, `move_obstacle` and `remove_obstacle`, as
/// JSON or YAML. `source` is used in messages. Errors: kParse.
[[nodiscard]] Result<ObstacleEdit> read_edit(std::string_view text, std::string_view source);
/// The edit as JSON in one line, with all defaults; only the member that is set. read_edit() gives
/// an equal value.
[[nodiscard]] std::string write_edit(const ObstacleEdit& edit);
/// Whether an edit that code has put together is one that read_edit() accepts. Errors: kParse.
[[nodiscard]] Status check_edit(const ObstacleEdit& edit);

/// The world as YAML, of its obstacles only what is set. read_world_text gives an equal value.
[[nodiscard]] std::string write_world(const WorldFile& world);

/// The JSON Schema (draft 07) of world files.
[[nodiscard]] std::string world_schema();

}  // namespace rave::config
