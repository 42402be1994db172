// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "companion_fields.hpp"
#include "rave/base/named_path.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

constexpr std::string_view kWork = "{work}";
constexpr std::string_view kScenario = "{scenario}";

/// Whether there was any.
bool replace(std::string& text, std::string_view word, std::string_view by) {
  bool any = false;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
    text.replace(at, word.size(), by);
    at += by.size();
    any = true;
  }
  return any;
}

void replace(RawNode& node, std::string_view word, std::string_view by) {
  for (std::size_t i = 0; i < node.size(); ++i) replace(node.child(i), word, by);
  if (!node.is_text()) return;
  std::string text = node.scalar();
  if (!replace(text, word, by)) return;
  const SourceLocation where = node.where();
  node = RawNode::text(std::move(text));
  node.set_where(std::make_shared<const std::string>(where.file), where.line, where.column);
}

void replace(CompanionFile& companion, std::string_view word, std::string_view by) {
  for (std::string& text : *companion.command) replace(text, word, by);
  for (auto& [name, value] : companion.environment) replace(value, word, by);
}

void set_work(RobotFile& robot, std::string_view work) {
  const auto all = [work](auto& entries) {
    for (auto& entry : entries) replace(entry.params, kWork, work);
  };
  all(robot.devices);
  all(robot.sensors);
  all(robot.actuators);
  all(robot.controllers);
  all(robot.transmitters);
  all(robot.communicators);
  for (SensorFile& sensor : robot.sensors) {
    if (sensor.real) replace(sensor.real->params, kWork, work);
    if (sensor.imagined) replace(sensor.imagined->params, kWork, work);
  }
  if (robot.program) replace(robot.program->params, kWork, work);
  for (auto& [name, value] : robot.variables) replace(value, kWork, work);
}

}  // namespace

void validate(const CompanionFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  if (!c.command->empty() && c.command->front().empty()) {
    check.error("command", "`command`: expected a program as its first item");
  }
  for (const std::string& word : *c.command) {
    if (word.find('\0') == std::string::npos) continue;
    check.error("command", "`command`: found a zero character, which no argument can have");
    break;
  }
  for (const auto& [name, value] : c.environment) {
    if (!is_variable_name(name)) {
      check.error("environment", "`{}` cannot name a variable: expected letters, digits and `_`",
                  name);
    } else if (!value.is_scalar()) {
      check.error_at(value.where(), "the variable `{}`: found {}, expected a text or number", name,
                     value.found_text());
    }
  }
}

void expand_companion(CompanionFile& companion, const std::filesystem::path& folder) {
  replace(companion, kScenario, folder.string());
  std::string& program = companion.command->front();
  // A name alone is looked for when the run starts; `{work}` is not known yet.
  if (program.find('/') == std::string::npos || program.starts_with(kWork)) return;
  program = named_path(folder, program).lexically_normal().string();
}

void set_work_folder(ExpandedScenario& scenario, const std::filesystem::path& folder) {
  for (CompanionFile& companion : scenario.scenario.companions) {
    replace(companion, kWork, folder.string());
  }
  for (RobotGroup& group : scenario.groups) {
    set_work(group.robot, folder.string());
    if (group.twin) set_work(group.twin->robot, folder.string());
  }
}

}  // namespace rave::config
