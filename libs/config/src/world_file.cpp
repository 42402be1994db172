// SPDX-License-Identifier: Apache-2.0
#include "rave/config/world_file.hpp"

#include "brief_list.hpp"
#include "world_fields.hpp"

namespace rave::config {

Result<WorldFile> read_world_text(std::string_view text, std::string_view file_name) {
  return read_text<WorldFile>(text, file_name);
}

Result<ObstacleEdit> read_edit(std::string_view text, std::string_view source) {
  return read_text<ObstacleEdit>(text, source);
}

std::string write_edit(const ObstacleEdit& edit) {
  RawNode node = codec::write_node(edit);
  for (const char* const key : {"add_obstacle", "move_obstacle", "remove_obstacle"}) {
    if (node.find(key)->is_null()) node.erase(key);
  }
  return codec::to_json_line(node);
}

Status check_edit(const ObstacleEdit& edit) {
  RAVE_TRY(codec::read_node<ObstacleEdit>(codec::write_node(edit)));
  return {};
}

Result<WorldFile> read_world_file(const std::filesystem::path& path) {
  return read_file<WorldFile>(path);
}

std::string write_world(const WorldFile& world) {
  RawNode tree = codec::write_node(WorldFile{world.description, {}, world.maps});
  tree.set("obstacles", brief_list(world.obstacles));
  return to_yaml(tree);
}

}  // namespace rave::config
