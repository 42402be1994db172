// SPDX-License-Identifier: Apache-2.0
#include "rave/config/world_file.hpp"

#include "world_fields.hpp"

namespace rave::config {

Result<WorldFile> read_world_text(std::string_view text, std::string_view file_name) {
  return read_text<WorldFile>(text, file_name);
}

Result<ObstacleFile> read_obstacle_text(std::string_view text, std::string_view file_name) {
  return read_text<ObstacleFile>(text, file_name);
}

Result<MoveObstacleFile> read_move_text(std::string_view text, std::string_view file_name) {
  return read_text<MoveObstacleFile>(text, file_name);
}

Result<WorldFile> read_world_file(const std::filesystem::path& path) {
  return read_file<WorldFile>(path);
}

std::string write_world(const WorldFile& world) { return write_text(world); }

}  // namespace rave::config
