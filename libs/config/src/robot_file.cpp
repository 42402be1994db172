// SPDX-License-Identifier: Apache-2.0
#include "rave/config/robot_file.hpp"

#include "robot_fields.hpp"

namespace rave::config {

Result<RobotFile> read_robot_text(std::string_view text, std::string_view file_name,
                                  const Variables& given) {
  return read_text<RobotFile>(text, file_name, [&given](RawNode& tree, Diagnostics& diagnostics) {
    substitute_variables(tree, given, diagnostics);
  });
}

Result<RobotFile> read_robot_file(const std::filesystem::path& path, const Variables& given) {
  RAVE_TRY_ASSIGN(const std::string text, rave::read_file(path, kMaxFileBytes));
  return read_robot_text(text, path.string(), given);
}

std::string write_robot(const RobotFile& robot) {
  RawNode tree = codec::write_node(robot);
  escape_variables(tree);
  return codec::to_yaml(tree);
}

}  // namespace rave::config
