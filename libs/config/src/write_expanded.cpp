// SPDX-License-Identifier: Apache-2.0
// An expanded scenario as one file, which reads back as the same scenario.
#include <utility>

#include "brief_list.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "scenario_fields.hpp"

namespace rave::config {
namespace {

RobotEntry entry_of(const RobotGroup& group) {
  RobotEntry entry;
  entry.name = group.name;
  entry.part_of = group.part_of;
  entry.team = group.team;
  entry.kind = group.kind;
  entry.robot = group.robot;
  entry.scatter = group.scatter;
  if (!group.file.empty()) entry.file = Located<std::string>(group.file);
  entry.hand_over = group.hand_over;
  entry.shadow = group.shadow;
  if (!group.twin) return entry;
  entry.twin_robot = group.twin->robot;
  if (!group.twin->file.empty()) entry.twin = Located<std::string>(group.twin->file);
  return entry;
}

/// Adds the poses of the group's robots.
void add_poses(std::span<const ExpandedRobot> robots, RobotEntry& entry) {
  if (robots.empty() || !robots.front().pose) return;
  if (robots.size() == 1) {
    entry.pose = robots.front().pose;
    return;
  }
  auto& poses = entry.poses.emplace();
  for (const ExpandedRobot& robot : robots) {
    poses.push_back({robot.pose->x_m, robot.pose->y_m, robot.pose->yaw_deg});
  }
}

RawNode escaped(RawNode node) {
  escape_variables(node);
  return node;
}

}  // namespace

std::string write_expanded(const ExpandedScenario& expanded) {
  ScenarioFile scenario = expanded.scenario;
  scenario.maps = expanded.world.maps;
  std::size_t first = 0;
  for (std::size_t group = 0; group < expanded.groups.size(); ++group) {
    std::size_t end = first;
    // Robots of a group follow each other, in the order of the entries.
    while (end < expanded.robots.size() && expanded.robots[end].group == group) ++end;
    RobotEntry& entry = scenario.robots.emplace_back(entry_of(expanded.groups[group]));
    add_poses(std::span(expanded.robots).subspan(first, end - first), entry);
    first = end;
  }
  const auto changes = std::exchange(scenario.changes, {});
  codec::RawNode tree = codec::write_node(scenario);
  tree.set("obstacles", brief_list(expanded.world.obstacles));
  tree.set("changes", brief_list(changes));
  // `$(` in values must not be taken for a variable when the text is read again.
  RawNode robots = *tree.find("robots");
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (const char* const key : {"robot", "twin_robot"}) {
      const RawNode* const robot = robots.child(i).find(key);
      if (robot != nullptr && robot->is_mapping()) robots.child(i).set(key, escaped(*robot));
    }
  }
  tree.set("robots", std::move(robots));
  return codec::to_yaml(tree);
}

}  // namespace rave::config
