// SPDX-License-Identifier: Apache-2.0
#include "played_maps.hpp"

#include "rave/config/map_image.hpp"
#include "rave/config/yaml.hpp"

namespace rave::replay {
namespace {

namespace fs = std::filesystem;
using codec::RawNode;

/// The YAML of a map whose image is beside it.
std::string with_image(const std::string& yaml, const std::string& image) {
  codec::Diagnostics diagnostics;
  auto root = config::parse_yaml(yaml, "map", diagnostics);
  root->set("image", RawNode::text(image));
  return codec::to_yaml(*root);
}

}  // namespace

Result<std::vector<PlayedScenario::File>> take_maps(config::ExpandedScenario& original) {
  std::vector<PlayedScenario::File> files;
  for (std::size_t i = 0; i < original.world.maps.size(); ++i) {
    std::string& name = original.world.maps[i].file.value;
    const fs::path yaml_path = name;
    RAVE_TRY_ASSIGN(const config::MapFiles map, config::read_map_files(yaml_path, original.files));
    // By number, because maps of several folders may have one name.
    const fs::path folder = fs::path("maps") / std::to_string(i + 1);
    const std::string image = map.image_path.filename().string();
    const bool beside = map.image_path == yaml_path.parent_path() / image;
    files.push_back(
        {folder / yaml_path.filename(), beside ? *map.yaml : with_image(*map.yaml, image)});
    files.push_back({folder / image, *map.image});
    name = (folder / yaml_path.filename()).generic_string();
  }
  return files;
}

}  // namespace rave::replay
