// SPDX-License-Identifier: Apache-2.0
// JSON Schemas of the files, made from the same descriptions that read them. Editors use them;
// robot files additionally allow variables.
#include <algorithm>

#include "scenario_fields.hpp"

namespace rave::config {
namespace {

constexpr const char* kOneVariable = "^\\$\\([A-Za-z_][A-Za-z0-9_]*\\)$";

bool is_type(const RawNode& node, std::string_view type) {
  return node.is_text() && node.scalar() == type;
}

RawNode variable_schema() {
  return RawNode::mapping(
      {{"type", RawNode::text("string")}, {"pattern", RawNode::text("\\$\\(")}});
}

/// Converts `{type: T, …}` to `{type: [T, string], pattern: …, …}`: limits of numbers do not apply
/// to strings, and the pattern does not apply to numbers.
void allow_variable_as_number(RawNode& schema) {
  RawNode& type = *schema.find("type");
  type = RawNode::sequence({type, RawNode::text("string")});
  schema.append("pattern", RawNode::text(kOneVariable));
}

void allow_variable_as_choice(RawNode& schema) {
  RawNode choice = RawNode::mapping();
  for (const char* key : {"type", "enum"}) {
    choice.append(key, *schema.find(key));
    (void)schema.erase(key);
  }
  schema.append("anyOf", RawNode::sequence({std::move(choice), variable_schema()}));
}

/// Extends the schema of robot files so that `$(name)` is valid for every number, bool and choice.
void allow_variables(RawNode& schema) {
  if (!schema.is_mapping()) return;
  const RawNode* type = schema.find("type");
  const bool scalar =
      type && (is_type(*type, "number") || is_type(*type, "integer") || is_type(*type, "boolean"));
  if (scalar) return allow_variable_as_number(schema);
  if (type && schema.find("enum")) return allow_variable_as_choice(schema);
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const std::string& key = schema.key(i);
    RawNode& child = schema.child(i);
    if (key == "items") allow_variables(child);
    if (key == "properties" || key == "anyOf") {
      for (std::size_t k = 0; k < child.size(); ++k) allow_variables(child.child(k));
    }
  }
}

}  // namespace

std::string robot_schema() {
  RawNode schema = Codec<RobotFile>::schema({});
  allow_variables(schema);
  return codec::json_schema(schema, "RAVE robot file", "robot.schema.json");
}

std::string world_schema() {
  return codec::json_schema(Codec<WorldFile>::schema({}), "RAVE world file", "world.schema.json");
}

std::string scenario_schema() {
  RawNode schema = Codec<ScenarioFile>::schema({});
  RawNode* entry = &schema;
  for (const char* key : {"properties", "robots", "items", "properties"}) {
    entry = entry->find(key);
  }
  // Robots written into a scenario have variables as those in files of their own do.
  for (const char* key : {"robot", "twin_robot"}) allow_variables(*entry->find(key));
  return codec::json_schema(schema, "RAVE scenario file", "scenario.schema.json");
}

}  // namespace rave::config
