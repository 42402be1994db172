// SPDX-License-Identifier: Apache-2.0
#include "rave/config/robot_file.hpp"

#include "robot_fields.hpp"

namespace rave::config {

Result<RobotFile> read_robot_text(std::string_view text, std::string_view file_name,
                                  const Variables& given) {
  Diagnostics diagnostics;
  RobotFile robot;
  if (auto tree = parse_yaml(text, file_name, diagnostics)) {
    const std::size_t errors_before = diagnostics.size();
    substitute_variables(*tree, given, diagnostics);
    // Skipped after an error: an unresolved variable would be reported again as a text instead of a
    // number.
    if (diagnostics.size() == errors_before) robot = read_node<RobotFile>(*tree, diagnostics);
  }
  if (diagnostics.ok()) return robot;
  diagnostics.sort();
  return tl::unexpected<Error>(diagnostics.joined());
}

Result<RobotFile> read_robot_file(const std::filesystem::path& path, const Variables& given) {
  RAVE_TRY_ASSIGN(const std::string text, rave::read_file(path, kMaxFileBytes));
  return read_robot_text(text, path.string(), given);
}

std::string write_robot(const RobotFile& robot) {
  RawNode tree = write_node(robot);
  escape_variables(tree);
  return to_yaml(tree);
}

}  // namespace rave::config
